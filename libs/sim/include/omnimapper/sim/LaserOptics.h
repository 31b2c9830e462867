#pragma once

#include <omnimapper/sim/Sensor.h>
#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Scene.h>

#include <vector>

namespace omnimapper::sim {

/// Optical effects on a laser's beam. By default the laser is ideal.
struct LaserOpticsOptions {
  double min_range = 0;    ///< [m]
  double max_range = 100;  ///< [m]
  /// Range at which a white wall (it reflects 0.9) can only just be measured face-on [m]; 0: the range does not depend
  /// on reflection.
  double white_range = 0;
  double divergence = 0;       ///< full angle of the beam's cone [rad]; 0: a line
  double noise = 0;            ///< constant part of the standard deviation of ranges [m]
  double noise_per_metre = 0;  ///< increase of that standard deviation per metre of range
  double step = 0;             ///< ranges are multiples of this step [m]; 0: they are not rounded
  /// Largest distance [m] between two surfaces in one beam whose ranges are mixed. The beam then reports their mean,
  /// weighted by power.
  double mixing_gap = 0;
  /// Part of the beams with several surfaces in which the ranges are mixed; the others report the range of the
  /// strongest echo.
  double mixing = 0;
  double lost = 0;  ///< part of the echoes that are missed at random
  /// Standard deviation of the bell curve by which the probability that a pane itself is measured falls as the angle of
  /// incidence grows [rad]; 0: panes are never measured and never mirror.
  double glass_angle = 0;
};

struct Beam {
  Eigen::Vector3d origin_in_map;     ///< [m]
  Eigen::Vector3d direction_in_map;  ///< unit
};

/// The measurement of one beam.
struct Echo {
  bool is_valid = false;
  double range = 0;  ///< as measured [m], if valid
  int surface = -1;  ///< number of the surface that sent back the strongest echo; -1: none
  /// Range of that surface along the beam's axis or, if the axis misses it, its mean range in the beam [m]; 0: none.
  double true_range = 0;
  double cosine = 0;                                 ///< of the angle of incidence
  Eigen::Vector3d in_map = Eigen::Vector3d::Zero();  ///< point at true_range on the beam's axis [m]
  double reflected = 0;      ///< part of the light that the surface scatters back, times the cosine of incidence
  bool is_mixed = false;     ///< the range is a mean of several surfaces
  bool is_mirrored = false;  ///< a pane mirrored the beam on its way
};

/// Points of the echoes that show a surface well: valid, neither mixed nor mirrored, and isSeenWell().
std::vector<VisiblePoint> seenPoints(const std::vector<Echo>& echoes);

/// Casts beams like those of a real laser. A pane of glass lets a beam through, sends it back (mostly if the beam meets
/// it nearly face-on) or mirrors it (mostly at grazing angles, by Fresnel's law). To find edges, each beam casts
/// `scouts` rays: 1 along its axis, or 3 along its axis and its two sides. If the rays of a beam meet different
/// surfaces, or its axis and that of a neighbouring beam do, kFootprint more rays fill its cone. Beams are neighbours
/// in the order in which they are given.
class LaserOptics {
 public:
  static constexpr int kFootprint = 16;

  LaserOptics(const LaserOpticsOptions& options, const Scenes& scenes, int scouts);
  /// randoms[i] is the random stream of beam i.
  std::vector<Echo> measure(const Scene& scene, const std::vector<Beam>& beams, std::vector<Random> randoms) const;

 private:
  struct Return;
  struct Fate;
  std::vector<Return> cast(const Scene& scene, const std::vector<Beam>& rays, const std::vector<int>& beam_of,
                           const std::vector<Fate>& fates) const;
  Echo combine(const std::vector<Return>& returns, Random& random) const;
  Echo noisy(Echo echo, double power, Random& random) const;

  LaserOpticsOptions options_;
  const Scenes& scenes_;
  int scouts_;
};

}  // namespace omnimapper::sim

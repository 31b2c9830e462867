#pragma once

#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Scene.h>

#include <vector>

namespace omnimapper::sim {

/// What becomes of a laser's beam on its way. All ideal as it is born.
struct LaserOpticsOptions {
  double min_range = 0;    ///< [m]
  double max_range = 100;  ///< [m]
  /// Range at which a white wall (reflects 0.9) seen face-on can only just be measured [m]; 0: reflection never
  /// matters.
  double white_range = 0;
  double divergence = 0;       ///< full angle of the beam's cone [rad]; 0: a line
  double noise = 0;            ///< standard deviation of ranges [m] ...
  double noise_per_metre = 0;  ///< ... and what is added to it with each metre of range
  double step = 0;             ///< ranges are multiples of it [m]; 0: they are not rounded
  /// A beam that meets two things no farther apart than this is not told apart [m]: the range is the mean by power.
  double mixing_gap = 0;
  double mixing = 0;       ///< part of such beams to which that happens; the others give the stronger one's range
  double lost = 0;         ///< part of the beams that come back and are not measured all the same
  double glass_angle = 0;  ///< incidence at which a pane is seen itself, as one sigma of a bell [rad]; 0: never
};

struct Beam {
  Eigen::Vector3d origin_in_map;     ///< [m]
  Eigen::Vector3d direction_in_map;  ///< unit
};

/// What comes back of a beam.
struct Echo {
  bool is_valid = false;
  double range = 0;       ///< as measured [m], if valid
  int surface = -1;       ///< that sent it back, the stronger one if two did; -1: none
  double true_range = 0;  ///< to that surface along the beam's middle, or mean of its part of the beam [m]; 0: none
  double cosine = 0;      ///< of incidence
  Eigen::Vector3d in_map = Eigen::Vector3d::Zero();  ///< at true_range on the beam's middle [m]
  double reflected = 0;      ///< part of the light scattered back by it, times the cosine of incidence
  bool is_mixed = false;     ///< of two surfaces
  bool is_mirrored = false;  ///< by a pane, seen at a grazing angle
};

/// Of those that show a surface well.
std::vector<SeenPoint> seenPoints(const std::vector<Echo>& echoes);

/// Casts beams as a real laser's. Panes are passed, seen (near face-on) or mirror (grazing, by Fresnel's law).
/// At `scout` rays for each beam edges are looked for: 1 its middle, 3 its sides too; where a beam or its neighbour
/// sees two surfaces, kFootprint more rays fill its cone. Beams are neighbours in the order they are given.
class LaserOptics {
 public:
  static constexpr int kFootprint = 16;

  LaserOptics(const LaserOpticsOptions& options, const Scenes& scenes, int scouts);
  /// randoms[i] is the stream of beam i.
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

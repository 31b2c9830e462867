#pragma once

#include <omnimapper/sim/LaserOptics.h>
#include <omnimapper/sim/Sensor.h>

#include <utility>

namespace omnimapper::sim {

enum class Laser2dModel { sick_lms291, sick_pls, hokuyo_utm30, hokuyo_urg04, ideal };

struct Laser2dOptions : LaserOpticsOptions {
  Laser2dModel model = Laser2dModel::sick_lms291;
  int beams = 181;
  double aperture = 3.14159265358979323846;  ///< from the first beam to the last [rad]
  bool counter_clockwise = true;
  double sweep = 0;            ///< from the first beam, which is at the stamp, to the last [s]
  bool no_echo_is_max = true;  ///< an invalid beam's range is max_range, else 0
  bool intensity = false;
  bool truth_ranges = false;  ///< the truth has the true range of each beam too

  /// The figures of sick_lms291.
  Laser2dOptions();
  explicit Laser2dOptions(std::in_place_t) {}  ///< ideal as LaserOpticsOptions are
  static Laser2dOptions ofModel(Laser2dModel model);
  static const base::OptionTable<Laser2dOptions>& table();
};

/// A 2D laser: CObservation2DRangeScan, with validRange false where nothing came back. Beam i is cast from where the
/// sensor is sweep * i / (beams - 1) after the stamp; sensorPose is that on the base.
/// Truth, one line for a scan: "surfaces" [[number + 1, count], ...] that the beams met (0: none in reach), indices of
/// beams: "missed" (no echo all the same: dark, too near or far, lost), "mixed" and "mirrored"; "ranges" [m] if asked
/// for.
class Laser2d : public Sensor {
 public:
  Laser2d(const Laser2dOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  std::vector<Echo> echoes(int k) const;

  Laser2dOptions options_;
  LaserOptics optics_;
};

/// Its class: keys that an INI does not give are those of its model.
SensorClass laser2dClass();

}  // namespace omnimapper::sim

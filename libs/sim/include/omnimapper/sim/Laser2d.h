#pragma once

#include <omnimapper/sim/LaserOptics.h>
#include <omnimapper/sim/Sensor.h>

#include <memory>
#include <utility>

namespace omnimapper::sim {

class PersonBeams;

enum class Laser2dModel { sick_lms291, sick_pls, hokuyo_utm30, hokuyo_urg04, ideal };

struct Laser2dOptions : LaserOpticsOptions {
  Laser2dModel model = Laser2dModel::sick_lms291;
  int beams = 181;
  double aperture = 3.14159265358979323846;  ///< angle from the first beam to the last [rad]
  bool counter_clockwise = true;
  double sweep = 0;            ///< time from the first beam, which is measured at the stamp, to the last [s]
  bool no_echo_is_max = true;  ///< the range of an invalid beam is max_range instead of 0
  bool intensity = false;
  bool truth_ranges = false;  ///< the truth contains the true range of each beam

  /// The values of sick_lms291.
  Laser2dOptions();
  explicit Laser2dOptions(std::in_place_t) {}  ///< ideal, as the defaults of LaserOpticsOptions
  static Laser2dOptions ofModel(Laser2dModel model);
  static const base::OptionTable<Laser2dOptions>& table();
};

/// A 2D laser: CObservation2DRangeScan, with validRange false where no echo came back. Beam i is cast from the pose
/// that the sensor has sweep * i / (beams - 1) after the stamp; sensorPose is the pose of the sensor on the base. The
/// truth has one line for each scan. "surfaces" [[number + 1, count], ...] lists, in the order of the beams, the
/// surfaces that were met (0: none in reach), each with the number of successive beams that met it. "missed", "mixed"
/// and "mirrored" are indices of beams; a missed beam met a surface but has no echo, because the echo was too weak, too
/// near, too far or lost. "ranges" [m] are there if truth_ranges is set. If there are people in the world, the file
/// truth/<label>_bodies.csv lists the beams that ended on them.
class Laser2d : public Sensor {
 public:
  Laser2d(const Laser2dOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  std::vector<Echo> echoes(int k) const;

  Laser2dOptions options_;
  LaserOptics optics_;
  std::shared_ptr<const PersonBeams> person_beams_;
};

/// The sensor class of Laser2d. Keys that an INI does not give take the values of its model.
SensorClass laser2dClass();

}  // namespace omnimapper::sim

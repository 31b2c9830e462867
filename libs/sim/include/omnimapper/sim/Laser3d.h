#pragma once

#include <omnimapper/sim/LaserOptics.h>
#include <omnimapper/sim/Sensor.h>

namespace omnimapper::sim {

/// Options of a turning 3D laser; the defaults are like those of a laser with 16 rings, for indoor and outdoor use.
struct Laser3dOptions : LaserOpticsOptions {
  int rings = 16;
  double lowest = -0.2617993877991494;  ///< elevation of the lowest ring [rad], up is positive
  double highest = 0.2617993877991494;  ///< elevation of the highest ring [rad]
  int columns = 900;                    ///< number of columns in a turn
  bool takes_time = true;               ///< a turn takes 1 / rate_hz; otherwise the whole turn is measured at one time
  Laser3dOptions();
  static const base::OptionTable<Laser3dOptions>& table();
};

/// A turning laser with many rings: a CObservationPointCloud of CPointsMapXYZI for each turn. A turn begins straight
/// ahead at the stamp and goes clockwise seen from above. Points are in the sensor's frame at the time of their column,
/// as from a driver that does not compensate the motion. They are ordered by column, and within a column from the
/// lowest ring up; beams without an echo are left out. The truth has one line for each turn: "surfaces" [[number + 1,
/// count], ...] lists, in the order of the points, the surfaces, each with the number of successive points on it;
/// "mixed" and "mirrored" are indices of points.
class Laser3d : public Sensor {
 public:
  Laser3d(const Laser3dOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  Laser3dOptions options_;
  LaserOptics optics_;
};

}  // namespace omnimapper::sim

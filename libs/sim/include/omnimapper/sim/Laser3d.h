#pragma once

#include <omnimapper/sim/LaserOptics.h>
#include <omnimapper/sim/Sensor.h>

namespace omnimapper::sim {

/// Figures like those of a turning laser of 16 rings, for indoor and outdoor use.
struct Laser3dOptions : LaserOpticsOptions {
  int rings = 16;
  double lowest = -0.2617993877991494;  ///< elevation of the lowest ring [rad], up is positive
  double highest = 0.2617993877991494;  ///< of the highest
  int columns = 900;                    ///< in a turn
  bool takes_time = true;               ///< a turn takes 1 / rate_hz; else all is measured at once
  Laser3dOptions();
  static const base::OptionTable<Laser3dOptions>& table();
};

/// A turning laser of many rings: CObservationPointCloud of CPointsMapXYZI, one turn each. It begins ahead at the stamp
/// and turns clockwise seen from above. Points are in the sensor's frame at the time of their column, as a driver that
/// does not undo the motion hands them out; column by column, each from the lowest ring up; beams without echo are left
/// out. Truth, one line each: "surfaces" [[number + 1, count], ...], "mixed" and "mirrored" over the points.
class Laser3d : public Sensor {
 public:
  Laser3d(const Laser3dOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  Laser3dOptions options_;
  LaserOptics optics_;
};

}  // namespace omnimapper::sim

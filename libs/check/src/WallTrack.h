#pragma once

#include <functional>
#include <map>
#include <vector>

#include "ScanPairs.h"

namespace omnimapper::check {

/// A wall as a line in the plane of the base: all points p with p . (cos azimuth, sin azimuth) = distance.
struct BaseWall {
  double azimuth = 0;   ///< [rad] direction from the base to the wall
  double distance = 0;  ///< [m] of the base's origin; negative if the sensor is on the other side of the wall than it
};

/// Scans of one laser, spread evenly over a log whose length is not known beforehand, and the walls in them.
class WallTrack {
 public:
  void add(const ScanPtr& scan);
  bool isEmpty() const { return scans_.empty(); }
  /// Walls around the base at a time, by the nearest scan and the motion of the base from it to that time. Empty if no
  /// scan is near.
  std::vector<BaseWall> wallsAt(base::Stamp stamp, const OdometryBetween& odometry) const;

 private:
  std::vector<ScanPtr> scans_;
  double spacing_ = 0.2;                                       // [s] least time between two of them
  mutable std::map<std::size_t, std::vector<BaseWall>> seen_;  // walls of the scans that were asked for
};

}  // namespace omnimapper::check

#pragma once

#include <vector>

#include "../robot/RobotSpace.h"

namespace omnimapper::sim {

/// What a companion keeps away from. Places are given at the times of the wished places.
struct CompanionObstacles {
  const RobotSpace& space;         ///< that of a person
  const Polyline& robot;           ///< places of the robot [m]
  double robot_distance = 0.52;    ///< least distance from the robot's place [m]
  std::vector<Polyline> others{};  ///< places of other people [m]
  double others_distance = 0;      ///< least distance from the places of other people [m]
};

/// Fastest motion of a companion [m/s].
constexpr double kFastestCompanion = 1.7;

/// The walk, of as many places as `wished`, that stays as near to the wished places as walls, furniture and robot
/// allow, and that avoids other people where it can. At each time, the place is at most `window` from the wished one
/// along x and along y [m]. Where the wished places are free, the walk consists of them. Empty: there is no such walk.
///
/// The walk is found by dynamic programming over time. The state is the offset from the wished place, in cells of 0.1
/// m. The costs are the squared offset and the squared change of the offset, over time. The walk is then smoothed.
Polyline walkNear(const Polyline& wished, const CompanionObstacles& obstacles, double window);

}  // namespace omnimapper::sim

#pragma once

#include <omnimapper/building/Storey.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::building {

/// Limits of straightOutlines(), in metres.
struct StraightWallOptions {
  double jog = 0.15;          ///< largest step in a wall that is straight in a plan
  double dent = 0.95;         ///< largest depth of furniture that stands at a wall
  double corner_area = 1.5;   ///< [m^2] largest area of furniture that stands in a corner
  double straightness = 0.7;  ///< [-] share of the outline that must run along the walls of the building
};

/// The direction of the walls of a storey: the angle from the x axis, in [-pi/4, pi/4) [rad], along or across which
/// most of the outlines of its rooms run.
double directionOfWalls(const Storey& storey);

/// The outlines of rooms as an architect would draw them, in the order of the rooms, counter-clockwise [m, map]: with
/// straight walls at right angles, and without the dents that furniture at walls and in corners leaves in the free
/// space, except at doors. A room whose walls run in other directions keeps its outline.
std::vector<std::vector<Eigen::Vector2d>> straightOutlines(const Storey& storey,
                                                           const StraightWallOptions& options = {});

}  // namespace omnimapper::building

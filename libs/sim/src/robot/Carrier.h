#pragma once

#include <omnimapper/sim/Drive.h>

namespace omnimapper::sim {

/// Poses of the base on the ground for the poses of a motion in the plane. Height, pitch and roll are those of the
/// ground under the robot's radius, smoothed over time so that kinks of the ground cause no jerks.
std::vector<geometry::Se3> poseOnGround(const std::vector<geometry::Se2>& motion, const World& world, double radius);

/// Adds eye height, the walker's sway, a wandering gaze and the shake of hands to poses on the ground. The motions are
/// sums of sines whose frequencies and phases `seed` determines.
void carryByHand(std::vector<geometry::Se3>& poses, const DriveOptions& options, std::uint64_t seed);

}  // namespace omnimapper::sim

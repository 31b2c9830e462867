#pragma once

#include <omnimapper/sim/Drive.h>

namespace omnimapper::sim {

/// Poses of the base on the ground below a motion of the plane, one for each of its poses. Height, pitch and roll are
/// those of the ground under the radius, smoothed over time so that kinks of the ground do not jerk.
std::vector<geometry::Se3> poseOnGround(const std::vector<geometry::Se2>& motion, const World& world, double radius);

/// What hands make of it: eye height, the walker's sway, a wandering gaze, shake. Sums of sines whose frequencies and
/// phases `seed` decides.
void carryByHand(std::vector<geometry::Se3>& poses, const DriveOptions& options, std::uint64_t seed);

}  // namespace omnimapper::sim

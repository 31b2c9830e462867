#pragma once

#include <omnimapper/matching/ScanWithNormals.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>
#include <vector>

namespace omnimapper::matching {

/// The scan of a floor plan from a pose by a laser of 181 beams over half a turn, lines fitted. Beams that meet no wall
/// within max_range are left out.
inline ScanWithNormals scanFrom(const testing::FloorPlan& plan, const mrpt::math::TPose2D& pose, double sigma = 0,
                                std::uint64_t seed = 1, double max_range = 12) {
  testing::Dice dice(seed);
  std::vector<Eigen::Vector2f> points;
  for (int i = -90; i <= 90; ++i) {
    const double angle = i * 3.14159265358979323846 / 180;
    const Eigen::Vector2d direction(std::cos(pose.phi + angle), std::sin(pose.phi + angle));
    const double range = plan.distanceToWall({pose.x, pose.y}, direction) + dice.normal(sigma);
    if (range < max_range) points.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return fitLines(points);
}

}  // namespace omnimapper::matching

#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/grid/BeamScan.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

namespace omnimapper::matching {

/// The scan of a floor plan from a pose by a laser with a beam for each degree of its aperture [deg]; beams longer than
/// max_range are misses.
inline grid::BeamScan beamsFrom(const testing::FloorPlan& plan, const mrpt::math::TPose2D& pose, double aperture = 180,
                                double max_range = 8, double sigma = 0, std::uint64_t seed = 1) {
  testing::Dice dice(seed);
  grid::BeamScan scan;
  for (double beam = -aperture / 2; beam < aperture / 2; beam += 1) {
    const double angle = beam * 3.14159265358979323846 / 180;
    const double range =
        plan.distanceToWall({pose.x, pose.y}, {std::cos(pose.phi + angle), std::sin(pose.phi + angle)}) +
        dice.normal(sigma);
    const double length = std::min(range, max_range);
    (range < max_range ? scan.hits : scan.misses).emplace_back(length * std::cos(angle), length * std::sin(angle));
  }
  return scan;
}

}  // namespace omnimapper::matching

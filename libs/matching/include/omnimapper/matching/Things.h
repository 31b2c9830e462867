#pragma once

#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::matching {

/// Numbers the things of a scan: compact pieces that stand apart from what is beside and behind them, such as a leg, a
/// chair, a pillar or a bin. They may move, while a long wall does not. Returns for each point the number of its thing,
/// from 0, or ScanWithNormals::kNoThing for a point of a wall; if the laser is too noisy, nothing is a thing. `points`
/// are in the order of the beams; `sensor`: position of the laser in their frame [m]; `noise`: rangeNoise() of the
/// points as they were measured [m].
std::vector<int> numberThings(const std::vector<Eigen::Vector2f>& points, const Eigen::Vector2f& sensor, float noise);

}  // namespace omnimapper::matching

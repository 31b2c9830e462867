#pragma once

#include <optional>
#include <vector>

#include "ScanPairs.h"

namespace omnimapper::check {

/// [m] The range ahead, with the standard deviation of single pairs, if it stays the same while the robot drives
/// straight on, by its odometry: the beams then meet the floor, because the laser is tilted, or a part of the robot.
/// None if the ranges ahead change, as those to walls do, or if the robot hardly drives straight on. Beams that meet
/// the floor according to the declared pose, and ranges of `limit` [m] or more, do not count.
std::optional<Measured> constantRangeAhead(const std::vector<ScanPair>& pairs, const OdometryBetween& odometry,
                                           double limit);

}  // namespace omnimapper::check

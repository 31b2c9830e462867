#pragma once

#include <omnimapper/check/LogFacts.h>

#include <vector>

#include "ScanPairs.h"

namespace omnimapper::check {

/// What the motions of some pairs say of odometry, its noise and the sensor's place. Labels and `tried` are the
/// caller's to fill in.
MotionFacts compareMotions(const std::vector<MatchedMotion>& motions);

}  // namespace omnimapper::check

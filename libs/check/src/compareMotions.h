#pragma once

#include <omnimapper/check/LogFacts.h>

#include <vector>

#include "ScanPairs.h"

namespace omnimapper::check {

/// What pairs of scans that declare an aperture [rad] say of odometry, its noise and the sensor's place; with another
/// aperture where the one they declare is wrong. Labels and `tried` are the caller's to fill in.
MotionFacts compareMotions(const std::vector<ScanPair>& pairs, double aperture, const OdometryBetween& odometry);

}  // namespace omnimapper::check

#pragma once

#include <omnimapper/check/LogFacts.h>

#include <vector>

#include "ScanPairs.h"

namespace omnimapper::check {

/// Judges odometry, its noise and the sensor's pose by pairs of scans that declare an aperture [rad], with another
/// aperture if the declared one is wrong. The caller fills in labels and `tried`.
MotionFacts compareMotions(const std::vector<ScanPair>& pairs, double aperture, const OdometryBetween& odometry);

}  // namespace omnimapper::check

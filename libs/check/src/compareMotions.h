#pragma once

#include <omnimapper/check/LogFacts.h>

#include <vector>

#include "ClockFit.h"
#include "ScanPairs.h"

namespace omnimapper::check {

/// The facts, and the motions that they were computed from.
struct ComparedMotions {
  MotionFacts facts;
  std::vector<MatchedMotion> motions;
};

/// Judges odometry, its clock, its noise and the sensor's pose by pairs of scans that declare an aperture [rad], with
/// another aperture if the declared one is wrong. `headings` are those of the odometry. If the clocks of both differ,
/// all motions of the odometry are those of the moments of the scans. The caller fills in labels and `tried`.
ComparedMotions compareMotions(const std::vector<ScanPair>& pairs, double aperture, const OdometryBetween& odometry,
                               const Headings& headings);

}  // namespace omnimapper::check

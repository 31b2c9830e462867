#pragma once

#include <optional>
#include <vector>

#include "ScanPairs.h"

namespace omnimapper::check {

/// The sweep with which scans that were taken while the base turned match best, and turn as the odometry does. Of the
/// pairs those in which the base turned most are used. A constant turn deforms both scans of a pair alike, so that only
/// the odometry shows the sweep: scans measure turns against the sense of the sweep too large and turns with it too
/// small. A turn that begins or ends shows it by the scans alone. `declared` [s] is the sweep to compare with. None if
/// the base turned too little.
std::optional<SweepFacts> fitSweep(const std::vector<ScanPair>& pairs, const std::vector<MatchedMotion>& motions,
                                   double declared);

}  // namespace omnimapper::check

#pragma once

#include <map>
#include <vector>

#include "Calibration.h"

namespace omnimapper::calibration {

/// How badly the log determines a group: its standard deviations over what is bearable; above 1 it does not.
double undetermined(Group group, const Adjusted& adjusted);

/// Findings of all groups that a camera has: those of `adjusted` as they came out of it, the others with the log's
/// values. `attempts`: for what was let go, the adjustment in which it was free for the last time.
std::vector<Finding> findingsOf(const DepthCamera& log, const Adjusted& adjusted,
                                const std::map<Group, Adjusted>& attempts, bool has_metres);

}  // namespace omnimapper::calibration

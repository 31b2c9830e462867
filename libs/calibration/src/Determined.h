#pragma once

#include <map>
#include <vector>

#include "Calibration.h"

namespace omnimapper::calibration {

/// The largest ratio of a standard deviation of a group to the largest acceptable one; above 1 the log does not
/// determine the group.
double undetermined(Group group, const Adjusted& adjusted);

/// Results of all groups of a camera. Groups that are free in `adjusted` are determined; the others have the values of
/// their last attempt, or the log's if there is none. `attempts` has, for each group that was dropped, the adjustment
/// in which it was free for the last time.
std::vector<GroupResult> resultsOf(const DepthCamera& log, const Adjusted& adjusted,
                                   const std::map<Group, Adjusted>& attempts, bool has_metres);

}  // namespace omnimapper::calibration

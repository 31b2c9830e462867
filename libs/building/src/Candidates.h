#pragma once

#include <vector>

#include "Cut.h"
#include "FreeSpace.h"

namespace omnimapper::building {

/// All places at which a room may end, with WallsAround. Of several at nearly the same place, only the best.
std::vector<Cut> candidateCuts(const FreeSpace& space, const SegmentationOptions& options);

}  // namespace omnimapper::building

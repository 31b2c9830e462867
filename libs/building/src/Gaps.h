#pragma once

#include <vector>

#include "Cut.h"
#include "FreeSpace.h"

namespace omnimapper::building {

/// Cuts along the lines of walls: where a wall is interrupted, or ends and would meet another one if it went on.
std::vector<Cut> gapsOfWalls(const FreeSpace& space, const SegmentationOptions& options);

}  // namespace omnimapper::building

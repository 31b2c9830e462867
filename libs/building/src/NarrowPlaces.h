#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Cut.h"
#include "FreeSpace.h"

namespace omnimapper::building {

/// The narrow places between wider ones: cuts through the saddles of the distance from obstacles.
std::vector<Cut> narrowPlaces(const FreeSpace& space);

}  // namespace omnimapper::building

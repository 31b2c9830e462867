#pragma once

#include <omnimapper/perception/PlaneRegion.h>

#include <vector>

namespace omnimapper::perception::planes {

/// Which corners of a closed line are enough for it: none that is left out is farther than `tolerance` [px] from the
/// line through those that are kept. In their order; all of them where fewer than three would remain. Source: Douglas,
/// Peucker: Algorithms for the reduction of the number of points required to represent a digitized line, 1973.
std::vector<int> simplified(const std::vector<PixelCorner>& corners, double tolerance);

}  // namespace omnimapper::perception::planes

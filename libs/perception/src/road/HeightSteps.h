#pragma once

#include <cstdint>
#include <vector>

#include "LocalGround.h"

namespace omnimapper::perception::road {

/// Finds steps in the height of the ground, such as the sides of kerbs and the feet of walls: 1 for their pixels, else
/// 0. At a step, the mean distances of pixels from the ground on the two sides of a straight line of some 76 px differ
/// by more than at the lines beside it, and by a discontinuity rather than a slope. There are two thresholds, as for
/// edges (J. Canny, PAMI 8(6), 1986): `deviations` standard deviations somewhere along a step, and 0.6 of that all
/// along it. A step is as wide as an upright face that joins both heights. `block_sigma` [1/m]: standard deviation of
/// the mean of 4 x 4 pixels.
std::vector<std::uint8_t> findHeightSteps(const LocalGround& ground, double block_sigma, double deviations);

}  // namespace omnimapper::perception::road

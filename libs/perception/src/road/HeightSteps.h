#pragma once

#include <cstdint>
#include <vector>

#include "LocalGround.h"

namespace omnimapper::perception::road {

/// 1 for pixels of steps, such as the sides of kerbs and the feet of walls: where the pixels on both sides of a
/// straight line of some 76 px are off the ground by means that differ, by more than beside it, and by a jump rather
/// than a slope. How much is told by two thresholds, as that of edges is (J. Canny, PAMI 8(6), 1986): somewhere along a
/// step by `deviations` standard deviations, all along it by 0.6 of that. A step is as wide as an upright face that
/// joins both heights. `block_sigma` [1/m]: standard deviation of the mean of 4 x 4 pixels.
std::vector<std::uint8_t> findHeightSteps(const LocalGround& ground, double block_sigma, double deviations);

}  // namespace omnimapper::perception::road

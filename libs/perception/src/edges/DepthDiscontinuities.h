#pragma once

#include <cstdint>

#include "../planes/InverseDepth.h"

namespace omnimapper::perception::edges {

struct JumpThresholds {
  float least = 0;   ///< [1/m] between neighbours
  float share = 0;   ///< of the nearer one's inverse depth
  int max_hole = 0;  ///< [px]
};

/// Adds kBoundary, kOccluding and kOccluded to the labels of an image's pixels (no padding); see EdgeDetector.
void markJumps(const planes::InverseDepth& inverse, const JumpThresholds& thresholds, std::uint8_t* labels);

}  // namespace omnimapper::perception::edges

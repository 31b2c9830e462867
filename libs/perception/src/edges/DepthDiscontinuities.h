#pragma once

#include <cstdint>

#include "../planes/InverseDepth.h"

namespace omnimapper::perception::edges {

struct DiscontinuityThresholds {
  float least = 0;   ///< [1/m] smallest difference of the inverse depths of two neighbours
  float share = 0;   ///< [-] smallest difference, relative to the inverse depth of the nearer one
  int max_hole = 0;  ///< [px] holes up to this width are bridged
};

/// Adds kBoundary, kOccluding and kOccluded to the labels of an image's pixels (no padding); see EdgeDetector.
void labelDepthDiscontinuities(const planes::InverseDepth& inverse, const DiscontinuityThresholds& thresholds,
                               std::uint8_t* labels);

}  // namespace omnimapper::perception::edges

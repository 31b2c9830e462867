#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "RgbdFrames.h"

namespace omnimapper::bench {

/// Somebody's way from a depth image and its picture to planes.
struct ComparatorPeer {
  std::string name;
  /// Hands over a frame; not timed.
  std::function<void(const RgbdFrame&)> take;
  /// For each pixel the number of its plane from 1 on, or 0; timed.
  std::function<std::vector<std::uint16_t>()> run;
};

/// None where bench-plane_comparators was built without it.
std::vector<ComparatorPeer> pclComparators();

}  // namespace omnimapper::bench

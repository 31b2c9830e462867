#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "RgbdFrames.h"

namespace omnimapper::bench {

/// A method that finds planes in a depth image and its colour image.
struct ComparatorPeer {
  std::string name;
  /// Receives a frame. Not timed.
  std::function<void(const RgbdFrame&)> take;
  /// For each pixel the number of its plane, from 1 on, or 0. Timed.
  std::function<std::vector<std::uint16_t>()> run;
};

/// PCL's methods; empty if bench-plane_comparators was built without PCL.
std::vector<ComparatorPeer> pclComparators();

}  // namespace omnimapper::bench

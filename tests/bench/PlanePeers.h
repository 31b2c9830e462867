#pragma once

#include <omnimapper/perception/DepthImage.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A 16-bit depth image.
struct DepthFrame {
  int width = 0, height = 0;
  double metres_per_unit = 1;
  perception::Pinhole camera;
  std::vector<std::uint16_t> units;
};

/// Somebody's way from a depth image to planes.
struct PlanePeer {
  std::string name;
  /// For each pixel the number of its plane from 1 on, or 0. What is called is what is timed: back-projection included.
  std::function<std::vector<std::uint16_t>(const DepthFrame&)> run;
};

/// None where bench-planes was built without them.
std::vector<PlanePeer> pclPlanes();
std::vector<PlanePeer> openCvPlanes();

}  // namespace omnimapper::bench

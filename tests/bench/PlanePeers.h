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

perception::DepthImage imageOf(const DepthFrame& frame);

std::vector<PlanePeer> ourPlanes();
/// Median times of the stages of ours on these frames, as a Markdown table.
void printOurStages(const std::vector<DepthFrame>& frames, int rounds);

/// None where bench-planes was built without PCL.
std::vector<PlanePeer> pclPlanes();
std::vector<PlanePeer> openCvPlanes();

/// Methods in a shared library that was built elsewhere; PlanePeerLibrary.h says what it holds. Throws
/// std::runtime_error for one that cannot be loaded.
std::vector<PlanePeer> loadedPlanes(const std::string& library);

}  // namespace omnimapper::bench

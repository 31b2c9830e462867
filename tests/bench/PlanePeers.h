#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A 16-bit depth image.
struct DepthFrame {
  int width = 0, height = 0;
  double metres_per_unit = 1;
  camera::Pinhole camera;
  std::vector<std::uint16_t> units;
};

/// A method that finds planes in a depth image.
struct PlanePeer {
  std::string name;
  /// For each pixel the number of its plane, from 1 on, or 0. The whole call is timed, including back-projection.
  std::function<std::vector<std::uint16_t>(const DepthFrame&)> run;
};

camera::DepthImage imageOf(const DepthFrame& frame);

std::vector<PlanePeer> ourPlanes();
/// Prints the median times of the stages of our method on these frames as a Markdown table.
void printOurStages(const std::vector<DepthFrame>& frames, int rounds);

/// PCL's methods; empty if bench-planes was built without PCL.
std::vector<PlanePeer> pclPlanes();
std::vector<PlanePeer> openCvPlanes();

/// The methods of a shared library that was built elsewhere; PlanePeerLibrary.h lists the functions that it must have.
/// Throws std::runtime_error if it cannot be loaded.
std::vector<PlanePeer> loadedPlanes(const std::string& library);

}  // namespace omnimapper::bench

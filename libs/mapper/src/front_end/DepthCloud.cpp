#include "front_end/DepthCloud.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/geometry/CubeSet.h>
#include <omnimapper/perception/viewOf.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::mapper {

namespace {

using mrpt::math::TPoint3D;
using mrpt::obs::CObservation3DRangeScan;

// Pixel step of the sampling; 3 cm apart at 4 m for a Kinect.
constexpr int kStride = 4;
// Largest relative difference in depth between neighbouring pixels of the same surface.
constexpr double kLargestStep = 0.05;

std::size_t indexOf(const camera::DepthImage& depth, int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width()) + static_cast<std::size_t>(u);
}

// Whether a pixel lies at a depth discontinuity.
bool isEdge(const camera::DepthImage& depth, int u, int v) {
  // In the units of the image.
  const auto at = [&](int x, int y) {
    const std::size_t i = indexOf(depth, x, y);
    return depth.units() != nullptr ? static_cast<double>(depth.units()[i]) : static_cast<double>(depth.metres()[i]);
  };
  const double here = at(u, v);
  const auto differs = [&](int x, int y) { return std::abs(at(x, y) - here) > kLargestStep * here; };
  return differs(std::min(u + 1, depth.width() - 1), v) || differs(u, std::min(v + 1, depth.height() - 1));
}

std::vector<map::CloudPoint> pointsOf(const CObservation3DRangeScan& scan, const camera::RgbdView& view,
                                      const CloudOptions& options) {
  constexpr obs::Rgb kGrey{128, 128, 128};
  std::vector<map::CloudPoint> cloud;
  const camera::DepthImage& depth = view.depth();
  const camera::Pinhole& camera = depth.camera();
  geometry::CubeSet cubes(options.voxel);
  for (int v = kStride / 2; v < depth.height(); v += kStride) {
    for (int u = kStride / 2; u < depth.width(); u += kStride) {
      const double forward = depth.at(indexOf(depth, u, v));
      if (!(forward > 0 && forward <= options.max_range) || isEdge(depth, u, v)) continue;
      const double left = -(u - camera.cx) / camera.fx, up = -(v - camera.cy) / camera.fy;
      const TPoint3D in_base = scan.sensorPose.composePoint({forward, forward * left, forward * up});
      constexpr double kReach = map::CloudPoint::kReach;
      if (!(std::abs(in_base.x) < kReach && std::abs(in_base.y) < kReach && std::abs(in_base.z) < kReach)) continue;
      if (!cubes.insert(in_base.x, in_base.y, in_base.z)) continue;
      const obs::Rgb colour = view.colours().exist() ? view.colours().at(u, v, forward).value_or(kGrey) : kGrey;
      const auto mm = [](double metres) { return map::CloudPoint::millimetres(static_cast<float>(metres)); };
      cloud.push_back({mm(in_base.x), mm(in_base.y), mm(in_base.z), colour.red, colour.green, colour.blue});
    }
  }
  return cloud;
}

}  // namespace

std::vector<map::CloudPoint> depthCloud(const mrpt::obs::CObservation& observation, const CloudOptions& options,
                                        perception::Blackboard& board) {
  const auto* scan = camera::depthScanOf(observation);
  if (scan == nullptr || !(options.voxel > 0)) return {};
  try {
    return pointsOf(*scan, perception::viewOf(*scan, board), options);
  } catch (const base::Error&) {  // the extractors and the odometry report images that cannot be used
    return {};
  }
}

}  // namespace omnimapper::mapper

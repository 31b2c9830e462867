#include "front_end/DepthCloud.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/CubeSet.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace omnimapper::mapper {

namespace {

using mrpt::math::TPoint3D;
using mrpt::obs::CObservation3DRangeScan;

// Pixel step of the sampling; 3 cm apart at 4 m for a Kinect.
constexpr int kStride = 4;
// Largest relative difference in depth between neighbouring pixels of the same surface.
constexpr double kLargestStep = 0.05;

// Colours of points from the image that was taken with the depth image.
class Colours {
 public:
  explicit Colours(const CObservation3DRangeScan& scan) : scan_(scan) {
    if (!scan.hasIntensityImage || scan.intensityImage.isEmpty()) return;
    if (scan.intensityImage.getPixelDepth() != mrpt::img::PixelDepth::D8U) return;
    width_ = static_cast<int>(scan.intensityImage.getWidth());
    height_ = static_cast<int>(scan.intensityImage.getHeight());
    is_colour_ = scan.intensityImage.isColor();
    sees_the_same_ = scan.doDepthAndIntensityCamerasCoincide() && width_ == static_cast<int>(scan.rangeImage.cols()) &&
                     height_ == static_cast<int>(scan.rangeImage.rows());
  }

  std::array<std::uint8_t, 3> at(int u, int v, const TPoint3D& in_sensor) const {
    constexpr std::array<std::uint8_t, 3> kGrey{128, 128, 128};
    if (width_ == 0) return kGrey;
    if (!sees_the_same_) {
      TPoint3D in_camera;
      scan_.relativePoseIntensityWRTDepth.inverseComposePoint(in_sensor, in_camera);
      if (!(in_camera.z > 0)) return kGrey;
      const auto& camera = scan_.cameraParamsIntensity;
      const double column = camera.fx() * in_camera.x / in_camera.z + camera.cx();
      const double row = camera.fy() * in_camera.y / in_camera.z + camera.cy();
      if (!(column >= 0 && column < width_ - 0.5 && row >= 0 && row < height_ - 0.5)) return kGrey;
      u = static_cast<int>(std::lround(column)), v = static_cast<int>(std::lround(row));
    }
    const auto channel = [&](int c) {
      return scan_.intensityImage.at<std::uint8_t>(u, v, static_cast<std::int8_t>(c));
    };
    if (!is_colour_) return {channel(0), channel(0), channel(0)};
    return {channel(2), channel(1), channel(0)};
  }

 private:
  const CObservation3DRangeScan& scan_;
  int width_ = 0, height_ = 0;
  bool is_colour_ = false, sees_the_same_ = false;
};

bool isEdge(const mrpt::math::CMatrix_u16& depth, int u, int v) {
  const double here = depth(v, u);
  const auto differs = [&](int du, int dv) {
    return std::abs(depth(std::min<int>(v + dv, depth.rows() - 1), std::min<int>(u + du, depth.cols() - 1)) - here) >
           kLargestStep * here;
  };
  return differs(1, 0) || differs(0, 1);
}

}  // namespace

std::vector<map::CloudPoint> depthCloud(const mrpt::obs::CObservation& observation, const CloudOptions& options) {
  std::vector<map::CloudPoint> cloud;
  const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
  if (!scan || !scan->hasRangeImage || !(options.voxel > 0)) return cloud;
  const auto& camera = scan->cameraParams;
  if (!(camera.fx() > 0) || !(camera.fy() > 0)) return cloud;
  const auto& depth = scan->rangeImage;
  const Colours colours(*scan);
  geometry::CubeSet cubes(options.voxel);
  for (int v = kStride / 2; v < static_cast<int>(depth.rows()); v += kStride) {
    for (int u = kStride / 2; u < static_cast<int>(depth.cols()); u += kStride) {
      const double range = depth(v, u) * static_cast<double>(scan->rangeUnits);
      if (!(range > 0 && range <= options.max_range) || isEdge(depth, u, v)) continue;
      const double left = -(u - camera.cx()) / camera.fx(), up = -(v - camera.cy()) / camera.fy();
      const double forward = scan->range_is_depth ? range : range / std::sqrt(1 + left * left + up * up);
      const TPoint3D in_sensor(forward, forward * left, forward * up);
      const TPoint3D in_base = scan->sensorPose.composePoint(in_sensor);
      constexpr double kReach = map::CloudPoint::kReach;
      if (!(std::abs(in_base.x) < kReach && std::abs(in_base.y) < kReach && std::abs(in_base.z) < kReach)) continue;
      if (!cubes.insert(in_base.x, in_base.y, in_base.z)) continue;
      const auto [red, green, blue] = colours.at(u, v, in_sensor);
      const auto mm = [](double metres) { return map::CloudPoint::millimetres(static_cast<float>(metres)); };
      cloud.push_back({mm(in_base.x), mm(in_base.y), mm(in_base.z), red, green, blue});
    }
  }
  return cloud;
}

}  // namespace omnimapper::mapper

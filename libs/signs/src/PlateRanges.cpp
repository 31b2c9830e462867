#include "PlateRanges.h"

#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <algorithm>
#include <cmath>

#include "Corners.h"

namespace omnimapper::signs {

namespace {

constexpr int kStride = 4;  // [px] step between the rows and columns of the depth image that are used

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

PlateRanges::PlateRanges(const mrpt::obs::CObservation3DRangeScan& scan, const camera::LensModel& lens) {
  if (!scan.hasRangeImage) return;
  const camera::RgbdView view(scan);
  const auto& image = view.depth();
  const auto& camera = image.camera();
  const bool is_one_view = camera::isPictureOfDepthView(scan);
  // Both frames are optical frames of their cameras.
  const geometry::Se3 picture_from_depth =
      geometry::inverse(geometry::fromMrpt(scan.relativePoseIntensityWRTDepth)) * geometry::sensorFromOptical();
  for (int row = kStride / 2; row < image.height(); row += kStride) {
    for (int column = kStride / 2; column < image.width(); column += kStride) {
      const double depth = image.at(static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width()) +
                                    static_cast<std::size_t>(column));
      if (!(depth > 0) || !std::isfinite(depth)) continue;
      if (is_one_view) {
        depth_pixels_.push_back({Eigen::Vector2f(static_cast<float>(column), static_cast<float>(row)), depth});
        continue;
      }
      const Eigen::Vector3d point = picture_from_depth * Eigen::Vector3d((column - camera.cx) / camera.fx * depth,
                                                                         (row - camera.cy) / camera.fy * depth, depth);
      constexpr double kNearest = 0.01;  // [m]
      if (point.z() > kNearest) depth_pixels_.push_back({lens.project(point).place.cast<float>(), point.z()});
    }
  }
}

std::optional<PlateRange> PlateRanges::of(const Corners& plate, const Eigen::Vector3d& ray) const {
  constexpr std::size_t kFewest = 12;
  constexpr double kMostSpread = 0.1;  // largest median deviation from the median, as a share of it
  std::vector<double> depths;
  for (const auto& [pixel, depth] : depth_pixels_)
    if (contains(plate, pixel)) depths.push_back(depth);
  if (depths.size() < kFewest || !(ray.z() > 0)) return std::nullopt;
  const double depth = medianOf(depths);
  const auto count = static_cast<double>(depths.size());
  for (auto& value : depths) value = std::abs(value - depth);
  if (medianOf(depths) > kMostSpread * depth) return std::nullopt;
  const camera::DepthNoise noise;
  const double relative =
      std::hypot(depth * std::sqrt(noise.meanVariance() / count + noise.distortionVariance()), noise.scale);
  return PlateRange{depth / ray.z(), relative * depth / ray.z()};
}

}  // namespace omnimapper::signs

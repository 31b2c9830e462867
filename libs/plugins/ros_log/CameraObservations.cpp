#include "CameraObservations.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <cstdlib>

#include "Images.h"
#include "ReorderBuffer.h"

namespace omnimapper::ros {

namespace {

constexpr double kMillimetre = 0.001;  // [m]

mrpt::img::CImage imageOf(const cv::Mat& pixels) {
  return mrpt::img::CImage(pixels, mrpt::img::DEEP_COPY);
}

mrpt::img::TCamera sized(mrpt::img::TCamera camera, const cv::Mat& image) {
  // An image of another size is the same view at another resolution.
  const double share = camera.ncols > 0 ? static_cast<double>(image.cols) / camera.ncols : 1;
  if (share != 1)
    camera.setIntrinsicParamsFromValues(camera.fx() * share, camera.fy() * share, camera.cx() * share,
                                        camera.cy() * share);
  camera.ncols = static_cast<std::uint32_t>(image.cols);
  camera.nrows = static_cast<std::uint32_t>(image.rows);
  return camera;
}

}  // namespace

void CameraObservations::keep(const std::string& topic, std::int64_t time, const Message& message) {
  constexpr std::size_t kMost = 40;
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 25;
  auto& pictures = pictures_[topic];
  pictures.emplace_back(time, detached(message));
  while (pictures.size() > 1 && (pictures.size() > kMost || pictures.size() * message.bytes.size() > kMostBytes))
    pictures.pop_front();
}

const Message* CameraObservations::nearestPicture(const std::string& topic, std::int64_t time) const {
  constexpr std::int64_t kLargest = 20'000'000;  // [ns] a little more than half the time between images at 30 Hz
  const auto pictures = pictures_.find(topic);
  if (pictures == pictures_.end()) return nullptr;
  const Message* nearest = nullptr;
  std::int64_t least = kLargest + 1;
  for (const auto& [at, message] : pictures->second) {
    if (std::abs(at - time) >= least) continue;
    least = std::abs(at - time);
    nearest = &message;
  }
  return nearest;
}

Converted CameraObservations::make(const std::string& topic, std::int64_t time, const Message& message,
                                   const Transforms& transforms) {
  const CameraUse& use = *plan_.use(topic);
  const auto value = decoder_.decode(message);
  if (!value) throw BadBytes("is damaged");
  if (use.is_depth) return depths(use, time, *value, transforms);
  const cv::Mat picture = pictureOf(*value);
  auto image = mrpt::obs::CObservationImage::Create();
  image->image = imageOf(picture);
  image->cameraParams = sized(use.camera, picture);
  return {image, use.frame, {}};  // its camera's pose is that of the optical frame
}

Converted CameraObservations::depths(const CameraUse& use, std::int64_t time, const Value& message,
                                     const Transforms& transforms) {
  const cv::Mat depths = depthsOf(message);
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->hasRangeImage = true;
  scan->range_is_depth = true;
  scan->rangeUnits = static_cast<float>(kMillimetre);
  scan->maxRange = static_cast<float>(65535 * kMillimetre);
  scan->rangeImage_setSize(depths.rows, depths.cols);
  for (int row = 0; row < depths.rows; ++row)
    for (int column = 0; column < depths.cols; ++column)
      scan->rangeImage(row, column) = depths.at<std::uint16_t>(row, column);
  scan->cameraParams = scan->cameraParamsIntensity = sized(use.camera, depths);
  const Message* found = use.picture.empty() ? nullptr : nearestPicture(use.picture, time);
  if (!use.picture.empty() && !found) ++without_picture_;
  const auto value = found ? decoder_.decode(*found) : std::nullopt;
  if (value) {
    const CameraUse& colours = *plan_.use(use.picture);
    const auto depth_from_picture = use.frame == colours.frame
                                        ? std::optional(geometry::Se3())
                                        : transforms.between(use.frame, colours.frame, time, kHeldBack);
    if (depth_from_picture) {
      const cv::Mat picture = pictureOf(*value);
      scan->hasIntensityImage = true;
      scan->intensityImage = imageOf(picture);
      scan->cameraParamsIntensity = sized(colours.camera, picture);
      scan->relativePoseIntensityWRTDepth = geometry::toMrpt(geometry::sensorFromOptical() * *depth_from_picture);
    }
  }
  return {scan, use.frame, geometry::inverse(geometry::sensorFromOptical())};
}

}  // namespace omnimapper::ros

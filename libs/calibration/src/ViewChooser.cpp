#include "ViewChooser.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omnimapper::calibration {

using mrpt::obs::CObservation3DRangeScan;

namespace {

std::vector<float> inverseDepths(const camera::DepthImage& depth) {
  constexpr std::uint16_t kSaturated = 65535;
  const auto count = static_cast<std::size_t>(depth.width()) * static_cast<std::size_t>(depth.height());
  std::vector<float> inverse(count, 0.F);
  for (std::size_t i = 0; i < count; ++i) {
    const double metres = depth.units() != nullptr
                              ? (depth.units()[i] == kSaturated ? 0 : depth.units()[i] * depth.metresPerUnit())
                              : static_cast<double>(depth.metres()[i]);
    if (std::isfinite(metres) && metres > 0.1) inverse[i] = static_cast<float>(1 / metres);
  }
  return inverse;
}

std::vector<std::uint8_t> greyOf(const mrpt::img::CImage& image) {
  const auto pixels = image.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
  cv::Mat grey = pixels;
  if (pixels.channels() == 3)
    cv::cvtColor(pixels, grey,
                 image.getChannelsOrder() == std::string("RGB") ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
  const cv::Mat dense = grey.isContinuous() ? grey : grey.clone();
  return {dense.data, dense.data + dense.total()};
}

bool hasPicture(const CObservation3DRangeScan& scan) {
  return scan.hasRangeImage && scan.hasIntensityImage && !scan.intensityImage.isEmpty() &&
         scan.intensityImage.getPixelDepth() == mrpt::img::PixelDepth::D8U;
}

}  // namespace

void ViewChooser::leaveOut(const std::string& why) {
  if (left_out_++ == 0) why_left_out_ = why;
}

void ViewChooser::add(const CObservation3DRangeScan::ConstPtr& scan) {
  try {
    if (!hasPicture(*scan)) return;
    if (!camera_) camera_ = cameraOf(*scan);
    if (!camera_) return;
    const auto width = scan->intensityImage.getWidth(), height = scan->intensityImage.getHeight();
    if (static_cast<int>(width) != camera_->width || static_cast<int>(height) != camera_->height) {
      leaveOut("its picture has " + std::to_string(width) + " x " + std::to_string(height) + " pixels and not " +
               std::to_string(camera_->width) + " x " + std::to_string(camera_->height));
      return;
    }
    follow(scan);
  } catch (const base::Error& error) {
    leaveOut(error.what());
  } catch (const mrpt::img::CExceptionExternalImageNotFound&) {
    leaveOut("its picture's file " + scan->intensityImage.getExternalStorageFile() + " cannot be read");
  }
}

void ViewChooser::follow(const CObservation3DRangeScan::ConstPtr& scan) {
  const auto straight = lens_.straightened(scan);
  const camera::RgbdView straight_view(*straight), raw_view(*scan);
  ++images_;
  using How = matching::RgbdTracker::Tracked::How;
  const auto tracked =
      tracker_.track(scan->timestamp, matching::RgbdPyramid(straight_view.depth(), straight_view.colour()));
  if (tracked.how == How::lost) {
    ++lost_;
    return;
  }
  if (tracked.how == How::begun) ++stretch_;
  CalibrationView view;
  if (tracked.how != How::begun) {
    const auto& depth_from_picture = camera_->depth_from_picture;
    const auto motion = inverse(depth_from_picture) * tracked.last_from_camera * depth_from_picture;
    const double seconds = std::max(1e-3, base::secondsBetween(tracked.last, scan->timestamp));
    const double travel = tracked.last_from_camera.translation.norm();
    const double angle = geometry::logSo3(tracked.last_from_camera.rotation).norm();
    travel_ += travel;
    turn_ += angle;
    view.turn_rate = angle / seconds;
    view.velocity = geometry::minus(motion, geometry::Se3()) / seconds;
    // The velocity at an image is the mean of those since the image before and until the one after.
    if (!kept_.empty() && kept_.back().view.stamp == tracked.last)
      kept_.back().view.velocity = 0.5 * (kept_.back().view.velocity + view.velocity);
  }
  view.stamp = scan->timestamp;
  view.stretch = stretch_;
  view.world_from_picture = tracked.map_from_camera * camera_->depth_from_picture;
  view.base_from_picture =
      geometry::fromMrpt(scan->sensorPose) * geometry::sensorFromOptical() * camera_->depth_from_picture;
  view.width = camera_->width;
  view.height = camera_->height;
  view.depth_width = raw_view.depth().width();
  view.depth_height = raw_view.depth().height();
  // The pixels are copied last, so that only views that are kept cost memory.
  const auto bin =
      static_cast<std::size_t>((travel_ / 0.08 + turn_ / (4 * base::option_text::kRadiansPerDegree)) / spacing_);
  if (!kept_.empty() && kept_.back().bin == bin && kept_.back().view.stretch == stretch_ &&
      kept_.back().view.turn_rate <= view.turn_rate)
    return;
  view.grey = greyOf(scan->intensityImage);
  view.inverse_depth = inverseDepths(raw_view.depth());
  if (!kept_.empty() && kept_.back().bin == bin && kept_.back().view.stretch == stretch_) {
    kept_.back().view = std::move(view);
  } else {
    kept_.push_back({std::move(view), bin});
  }
  if (kept_.size() >= 2 * most_ && spacing_ < kWidestSpacing) thin();
}

// Doubles the spacing; of two neighbouring bins the view with the slower rotation stays.
void ViewChooser::thin() {
  std::vector<Candidate> fewer;
  for (auto& one : kept_) {
    one.bin /= 2;
    const bool same = !fewer.empty() && fewer.back().bin == one.bin && fewer.back().view.stretch == one.view.stretch;
    if (!same) {
      fewer.push_back(std::move(one));
    } else if (one.view.turn_rate < fewer.back().view.turn_rate) {
      fewer.back() = std::move(one);
    }
  }
  kept_ = std::move(fewer);
  spacing_ *= 2;
}

std::vector<CalibrationView> ViewChooser::take() {
  while (kept_.size() > most_ && spacing_ < kWidestSpacing) thin();
  if (kept_.size() > most_) kept_.resize(most_);
  std::vector<CalibrationView> views;
  for (auto& one : kept_) views.push_back(std::move(one.view));
  kept_.clear();
  return views;
}

}  // namespace omnimapper::calibration

#include <omnimapper/base/Error.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <cmath>
#include <utility>

namespace omnimapper::camera {

namespace {

using mrpt::obs::CObservation3DRangeScan;

Pinhole pinholeOf(const mrpt::img::TCamera& camera) {
  return {camera.fx(), camera.fy(), camera.cx(), camera.cy()};
}

// Converts ranges along the rays to depths along the optical axis.
std::vector<float> depthsOf(const CObservation3DRangeScan& scan) {
  const Pinhole camera = pinholeOf(scan.cameraParams);
  const auto rows = static_cast<int>(scan.rangeImage.rows()), columns = static_cast<int>(scan.rangeImage.cols());
  std::vector<float> metres;
  metres.reserve(static_cast<std::size_t>(scan.rangeImage.size()));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint16_t range = scan.rangeImage(row, column);
      const double right = (column - camera.cx) / camera.fx, down = (row - camera.cy) / camera.fy;
      const double depth = range * static_cast<double>(scan.rangeUnits) / std::sqrt(1 + right * right + down * down);
      metres.push_back(range == DepthImage::kSaturated ? 0.F : static_cast<float>(depth));
    }
  }
  return metres;
}

}  // namespace

void refuseMissing(const std::string& label, const std::string& what, const std::string& file) {
  throw base::Error(base::ExitCode::missing_images,
                    label + ": the " + what + " image is in " + file + ", which was not loaded; is it there?");
}

ScanDepth::ScanDepth(const CObservation3DRangeScan& scan) {
  const auto& ranges = scan.rangeImage;
  if (ranges.size() == 0 && scan.hasRangeImage && scan.rangeImage_isExternallyStored())
    refuseMissing(scan.sensorLabel, "depth", scan.rangeImage_getExternalStorageFile(""));
  const auto width = static_cast<int>(ranges.cols()), height = static_cast<int>(ranges.rows());
  // An image without pixels needs no calibration.
  const Pinhole camera = ranges.size() > 0 ? pinholeOf(scan.cameraParams) : Pinhole();
  try {
    const std::uint16_t* units = ranges.size() > 0 ? ranges.data() : nullptr;
    image_.emplace(units, static_cast<double>(scan.rangeUnits), width, height, camera);
    if (scan.range_is_depth) return;
    metres_ = depthsOf(scan);
    image_.emplace(metres_.data(), width, height, camera);
  } catch (const base::Error& error) {
    throw base::Error(error.code(), scan.sensorLabel + ": " + error.what());
  }
}

ScanColours::ScanColours(const CObservation3DRangeScan& scan)
    : depth_camera_(pinholeOf(scan.cameraParams)), colour_camera_(pinholeOf(scan.cameraParamsIntensity)) {
  if (!scan.hasIntensityImage) return;
  try {
    readImage(scan.intensityImage);
  } catch (const mrpt::img::CExceptionExternalImageNotFound&) {
    refuseMissing(scan.sensorLabel, "colour", scan.intensityImage.getExternalStorageFile());
  }
  if (!exist()) return;
  // From the optical frame of the colour camera to MRPT's frame of the depth camera.
  const mrpt::poses::CPose3D& depth_from_colour = scan.relativePoseIntensityWRTDepth;
  const Eigen::Matrix3d colour_from_sensor = depth_from_colour.getRotationMatrix().asEigen().transpose();
  const Eigen::Vector3d colour_in_sensor(depth_from_colour.x(), depth_from_colour.y(), depth_from_colour.z());
  colour_from_depth_ = colour_from_sensor * geometry::sensorFromOptical().rotation.toRotationMatrix();
  depth_in_colour_ = -(colour_from_sensor * colour_in_sensor);
  same_view_ = isPictureOfDepthView(scan);
}

void ScanColours::readImage(const mrpt::img::CImage& image) {
  if (image.isEmpty() || image.getPixelDepth() != mrpt::img::PixelDepth::D8U) return;
  const auto channels = static_cast<int>(image.channelCount());
  if (channels != 1 && channels != 3) return;
  width_ = static_cast<int>(image.getWidth());
  channels_ = channels;
  red_first_ = image.getChannelsOrder() == std::string("RGB");
  rows_.resize(image.getHeight());
  for (std::size_t y = 0; y < rows_.size(); ++y) rows_[y] = image.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
}

std::optional<ScanColours::Place> ScanColours::placeInOtherView(int x, int y, double depth) const {
  const Eigen::Vector3d in_depth((x - depth_camera_.cx) / depth_camera_.fx * depth,
                                 (y - depth_camera_.cy) / depth_camera_.fy * depth, depth);
  const Eigen::Vector3d p = colour_from_depth_ * in_depth + depth_in_colour_;
  if (!(p.z() > 0)) return std::nullopt;
  const double u = colour_camera_.fx * p.x() / p.z() + colour_camera_.cx + 0.5;
  const double v = colour_camera_.fy * p.y() / p.z() + colour_camera_.cy + 0.5;
  if (!(u >= 0 && u < width_ && v >= 0 && v < static_cast<double>(rows_.size()))) return std::nullopt;
  return Place{static_cast<int>(u), static_cast<int>(v)};
}

void ScanColours::addRow(int y, int begin, int end, ColourSum& sum) const {
  const std::uint8_t* p = rows_[static_cast<std::size_t>(y)] + static_cast<std::ptrdiff_t>(channels_) * begin;
  std::uint32_t first = 0, second = 0, third = 0;
  if (channels_ < 3) {
    for (int x = begin; x < end; ++x) first += *p++;
    second = third = first;
  } else {
    for (int x = begin; x < end; ++x, p += 3) {
      first += p[0];
      second += p[1];
      third += p[2];
    }
  }
  if (!red_first_) std::swap(first, third);
  sum.add(first, second, third, static_cast<std::uint64_t>(end - begin));
}

std::vector<obs::Rgb> ScanColours::inDepthView(const ScanDepth& depth) const {
  const int width = depth.image().width(), height = depth.image().height();
  std::vector<obs::Rgb> colours(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++i) {
      const double z = depth.at(i);
      if (z > 0) colours[i] = at(x, y, z).value_or(obs::Rgb());
    }
  }
  return colours;
}

ColourImage ScanColours::picture() const {
  if (!exist()) return {};
  const auto height = static_cast<int>(rows_.size());
  const int stride = height > 1 ? static_cast<int>(rows_[1] - rows_[0]) : width_ * channels_;
  const auto order = channels_ < 3 ? ColourImage::Order::grey
                     : red_first_  ? ColourImage::Order::rgb
                                   : ColourImage::Order::bgr;
  return {rows_[0], width_, height, stride, order};
}

std::optional<obs::Rgb> ColourSum::mean() const {
  if (count_ == 0) return std::nullopt;
  const auto rounded = [&](std::uint64_t sum) { return static_cast<std::uint8_t>((sum + count_ / 2) / count_); };
  return obs::Rgb{rounded(red_), rounded(green_), rounded(blue_)};
}

}  // namespace omnimapper::camera

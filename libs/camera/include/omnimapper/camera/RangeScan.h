#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/camera/ColourImage.h>
#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/obs/Rgb.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::camera {

/// Turns a vector from a camera's optical frame (x right, y down, z forward) to MRPT's frame of a range camera (x
/// forward, y left, z up), which observations use: geometry::sensorFromOptical() without rounding errors.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> toSensor(const Eigen::Matrix<Scalar, 3, 1>& in_optical) {
  return {in_optical.z(), -in_optical.x(), -in_optical.y()};
}

/// The inverse of toSensor().
inline Eigen::Vector3d toOptical(const Eigen::Vector3d& in_sensor) {
  return {-in_sensor.y(), -in_sensor.z(), in_sensor.x()};
}

/// The depth image of an observation. The observation must outlive it.
class ScanDepth {
 public:
  /// Throws Error(missing_images) if the depths are in a file that was not loaded, and Error(unreadable_input) if the
  /// camera has no calibration; the message names the sensor.
  explicit ScanDepth(const mrpt::obs::CObservation3DRangeScan& scan);
  ScanDepth(const ScanDepth&) = delete;
  ScanDepth& operator=(const ScanDepth&) = delete;

  const DepthImage& image() const { return *image_; }
  /// [m]; 0 where nothing was measured.
  double at(std::size_t pixel) const { return image_->at(pixel); }

 private:
  std::vector<float> metres_;  // only if the scan has ranges along the rays
  std::optional<DepthImage> image_;
};

/// Accumulates colours and returns their mean.
class ColourSum {
 public:
  void add(const obs::Rgb& colour) { add(colour.red, colour.green, colour.blue, 1); }
  /// Adds the sums of `count` colours.
  void add(std::uint64_t red, std::uint64_t green, std::uint64_t blue, std::uint64_t count) {
    red_ += red;
    green_ += green;
    blue_ += blue;
    count_ += count;
  }
  /// None if no colour was added.
  std::optional<obs::Rgb> mean() const;

 private:
  std::uint64_t red_ = 0, green_ = 0, blue_ = 0, count_ = 0;
};

/// Colours of the points of a depth image. The observation must outlive it.
class ScanColours {
 public:
  /// Throws Error(missing_images) if the image is in a file that cannot be read.
  explicit ScanColours(const mrpt::obs::CObservation3DRangeScan& scan);

  /// Whether there is an image of 8 bits with 3 channels of colours, or 1 of greys.
  bool exist() const { return channels_ > 0; }
  /// Colour of the point that the depth pixel in column x and row y sees at `depth` [m]; none outside the picture.
  std::optional<obs::Rgb> at(int x, int y, double depth) const {
    if (same_view_) return pixel(x, y);
    const auto place = placeOf(x, y, depth);
    if (!place) return std::nullopt;
    return pixel(place->x, place->y);
  }

  /// Colours of all pixels of the depth image, row by row; black where there is no depth or no colour.
  std::vector<obs::Rgb> inDepthView(const ScanDepth& depth) const;

  /// Adds the colours of the pixels from column `begin` to before `end` of row y. Only if the picture has the view of
  /// the depth image.
  void addRow(int y, int begin, int end, ColourSum& sum) const;

  /// Column and row of the picture.
  struct Place {
    int x, y;
  };
  /// Where the picture shows the point that this depth pixel sees; none outside the picture or without one.
  std::optional<Place> placeOf(int x, int y, double depth) const {
    if (!exist()) return std::nullopt;
    return same_view_ ? Place{x, y} : placeInOtherView(x, y, depth);
  }
  /// The picture itself; its size is 0 if there is none.
  ColourImage picture() const;
  /// Whether the pixels of the picture coincide with those of the depth image.
  bool areOfDepthView() const { return same_view_; }
  /// Width of a depth pixel in pixels of the picture.
  double pixelsPerDepthPixel() const { return std::abs(colour_camera_.fx / depth_camera_.fx); }

 private:
  void readImage(const mrpt::img::CImage& image);
  std::optional<Place> placeInOtherView(int x, int y, double depth) const;
  obs::Rgb pixel(int x, int y) const {
    const std::uint8_t* p = rows_[static_cast<std::size_t>(y)] + static_cast<std::ptrdiff_t>(channels_) * x;
    if (channels_ < 3) return {p[0], p[0], p[0]};
    return red_first_ ? obs::Rgb{p[0], p[1], p[2]} : obs::Rgb{p[2], p[1], p[0]};
  }

  std::vector<const std::uint8_t*> rows_;
  int width_ = 0, channels_ = 0;
  bool red_first_ = false;
  bool same_view_ = false;  // see areOfDepthView()
  Pinhole depth_camera_, colour_camera_;
  Eigen::Matrix3d colour_from_depth_ = Eigen::Matrix3d::Identity();  // between optical frames
  Eigen::Vector3d depth_in_colour_ = Eigen::Vector3d::Zero();        // [m]
};

}  // namespace omnimapper::camera

#pragma once

#include <cstddef>
#include <cstdint>

namespace omnimapper::camera {

/// A pinhole camera, in pixels. The centre of the pixel in column u and row v has the image point (u, v); the ray
/// through it is ((u - cx) / fx, (v - cy) / fy, 1) in the optical frame: x right, y down, z forward.
struct Pinhole {
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;
};

/// A depth image that somebody else owns: rows from the top, without gaps between them. Each pixel holds the z
/// coordinate of the point that it sees. Depths that are zero, negative or not finite are no measurements; neither are
/// 16-bit depths of 65535, which are saturated.
class DepthImage {
 public:
  static constexpr std::uint16_t kSaturated = 65535;

  /// Both constructors throw Error(unreadable_input) for a negative size, more than 4096 columns or rows, missing
  /// pixels, a focal length below 1 px, an intrinsic parameter beyond 10^6 px, or a unit that is not positive or not
  /// finite.
  DepthImage(const std::uint16_t* units, double metres_per_unit, int width, int height, const Pinhole& camera);
  DepthImage(const float* metres, int width, int height, const Pinhole& camera);

  int width() const { return width_; }
  int height() const { return height_; }
  const Pinhole& camera() const { return camera_; }
  /// Either units() or metres() is null.
  const std::uint16_t* units() const { return units_; }
  const float* metres() const { return metres_; }
  double metresPerUnit() const { return metres_per_unit_; }
  /// Depth [m] of a pixel; 0 if it is saturated. Pixels are counted row by row from the top left.
  double at(std::size_t pixel) const {
    if (units_ == nullptr) return static_cast<double>(metres_[pixel]);
    return units_[pixel] == kSaturated ? 0 : units_[pixel] * metres_per_unit_;
  }

 private:
  const std::uint16_t* units_ = nullptr;
  const float* metres_ = nullptr;
  double metres_per_unit_ = 1;
  int width_, height_;
  Pinhole camera_;
};

}  // namespace omnimapper::camera

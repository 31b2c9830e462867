#pragma once

#include <mrpt/img/TCamera.h>

#include <Eigen/Core>
#include <optional>

namespace omnimapper::sim {

/// A camera without distortion. Optical frame: x to the right in the image, y down, z forward; (0, 0) is the centre of
/// the upper left pixel.
struct Pinhole {
  int width = 640, height = 480;                      ///< [pixel]
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  ///< [pixel]

  /// A camera with square pixels and the principal point in the middle of the image.
  static Pinhole centred(int width, int height, double focal) {
    return {width, height, focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)};
  }

  int count() const { return width * height; }
  /// The point at depth 1 that is seen at pixel (u, v), in the optical frame.
  Eigen::Vector3d through(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }
  /// The pixel at which a point is seen; it may lie outside the image. None for a point behind the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& in_optical) const {
    if (in_optical.z() < 1e-6) return std::nullopt;
    return Eigen::Vector2d(cx + fx * in_optical.x() / in_optical.z(), cy + fy * in_optical.y() / in_optical.z());
  }
  bool contains(const Eigen::Vector2d& at) const {
    return at.x() > -0.5 && at.y() > -0.5 && at.x() < width - 0.5 && at.y() < height - 0.5;
  }

  mrpt::img::TCamera toMrpt() const {
    mrpt::img::TCamera camera;
    camera.ncols = width;
    camera.nrows = height;
    camera.setIntrinsicParamsFromValues(fx, fy, cx, cy);
    return camera;
  }
};

}  // namespace omnimapper::sim

#pragma once

#include <mrpt/img/TCamera.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

namespace omnimapper::perception {

/// Columns and rows in an image [px], or x and y of rays at z = 1 of the optical frame (x right, y down, z forward), of
/// the corners of a marker or a sign: top left, top right, bottom right, bottom left.
using Corners = std::array<Eigen::Vector2d, 4>;

/// Where a camera sees what.
class LensModel {
 public:
  /// Throws Error(unreadable_input) for a focal length below 1 px, or a parameter not finite or beyond 10^6; `who` is
  /// in the message.
  LensModel(const mrpt::img::TCamera& camera, const std::string& who);

  /// The rays of image points; none where the lens shows no such ray.
  std::optional<Corners> raysOf(const Corners& in_image) const;

  struct Projection {
    Eigen::Vector2d place;                 ///< [px]
    Eigen::Matrix<double, 2, 3> by_point;  ///< [px/m]
  };
  /// Of a point before the camera, in the optical frame [m].
  Projection project(const Eigen::Vector3d& point) const;

 private:
  mrpt::img::TCamera camera_;
};

}  // namespace omnimapper::perception

#pragma once

#include <mrpt/img/TCamera.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

namespace omnimapper::camera {

/// The corners of a marker or a sign: top left, top right, bottom right, bottom left. They are columns and rows in an
/// image [px], or x and y of rays at z = 1 in the optical frame (x right, y down, z forward).
using Corners = std::array<Eigen::Vector2d, 4>;

/// Converts between the image points and the rays of a camera, including the distortion of its lens.
class LensModel {
 public:
  /// Throws Error(unreadable_input) for a focal length below 1 px or a parameter that is not finite or beyond 10^6;
  /// `who` names the camera in the message.
  LensModel(const mrpt::img::TCamera& camera, const std::string& who);

  /// The rays of four image points; none if one of the points has no ray in the lens model.
  std::optional<Corners> raysOf(const Corners& in_image) const;

  struct Projection {
    Eigen::Vector2d place;                 ///< [px]
    Eigen::Matrix<double, 2, 3> by_point;  ///< [px/m] derivative of `place` by the point
  };
  /// Projects a point in front of the camera, given in the optical frame [m].
  Projection project(const Eigen::Vector3d& point) const;

 private:
  mrpt::img::TCamera camera_;
};

}  // namespace omnimapper::camera

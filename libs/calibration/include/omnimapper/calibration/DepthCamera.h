#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <array>
#include <optional>

namespace omnimapper::calibration {

/// fx, fy, cx, cy [px], then the coefficients of the lens: k1, k2, p1, p2, k3 (Brown's model, as in OpenCV and MRPT's
/// plumb_bob).
using Intrinsics = std::array<double, 9>;

/// The pixel [px] at which a camera with these intrinsics sees the point `p` of its optical frame [m]. `Scalar` may be
/// a type that computes derivatives (a dual number).
template <class Scalar>
Eigen::Matrix<Scalar, 2, 1> project(const Scalar* camera, const Eigen::Matrix<Scalar, 3, 1>& p) {
  const Scalar x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const Scalar radial = 1.0 + r2 * (camera[4] + r2 * (camera[5] + r2 * camera[8]));
  const Scalar distorted_x = x * radial + 2.0 * camera[6] * x * y + camera[7] * (r2 + 2.0 * x * x);
  const Scalar distorted_y = y * radial + camera[6] * (r2 + 2.0 * y * y) + 2.0 * camera[7] * x * y;
  return {camera[0] * distorted_x + camera[2], camera[1] * distorted_y + camera[3]};
}

/// The ray (x, y, 1) in the optical frame that a camera sees in a pixel: the inverse of project().
Eigen::Vector3d rayThrough(const Intrinsics& camera, const Eigen::Vector2d& pixel);

/// The calibration of a camera with depths, as it is in a log or as it was estimated.
struct DepthCamera {
  Intrinsics picture{}, depth{};
  geometry::Se3 depth_from_picture;  ///< pose of the picture's optical frame in the optical frame of the depths
  double depth_scale = 1;            ///< true depth divided by the depth in the log
  int width = 0, height = 0;         ///< [px] size of the picture
  bool is_registered = false;        ///< the depths are registered to the picture: both belong to the camera `picture`

  const Intrinsics& depthCamera() const { return is_registered ? picture : depth; }
};

/// The calibration that the observation carries. None if a lens is a fisheye or has more than five coefficients, or if
/// a camera has no calibration.
std::optional<DepthCamera> cameraOf(const mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace omnimapper::calibration

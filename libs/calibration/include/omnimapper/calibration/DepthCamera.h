#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <array>
#include <optional>

namespace omnimapper::calibration {

/// fx, fy, cx, cy [px], then the lens: k1, k2, p1, p2, k3 (Brown's model as OpenCV and MRPT's plumb_bob have it).
using Intrinsics = std::array<double, 9>;

/// Where a camera with these intrinsics sees a point of its optical frame, [px]. Of any scalar, for derivatives.
template <class Scalar>
Eigen::Matrix<Scalar, 2, 1> project(const Scalar* camera, const Eigen::Matrix<Scalar, 3, 1>& p) {
  const Scalar x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const Scalar radial = 1.0 + r2 * (camera[4] + r2 * (camera[5] + r2 * camera[8]));
  const Scalar bent_x = x * radial + 2.0 * camera[6] * x * y + camera[7] * (r2 + 2.0 * x * x);
  const Scalar bent_y = y * radial + camera[6] * (r2 + 2.0 * y * y) + 2.0 * camera[7] * x * y;
  return {camera[0] * bent_x + camera[2], camera[1] * bent_y + camera[3]};
}

/// The ray (x, y, 1) that a camera sees in a pixel: the inverse of project().
Eigen::Vector3d rayThrough(const Intrinsics& camera, const Eigen::Vector2d& pixel);

/// A camera with depths, and what a log or a calibration says of it.
struct DepthCamera {
  Intrinsics picture{}, depth{};
  geometry::Se3 depth_from_picture;  ///< optical frames
  double depth_scale = 1;            ///< true depth over the log's
  int width = 0, height = 0;         ///< [px] of the picture
  bool is_registered = false;        ///< the depths are of the picture's view: one camera, of which `picture` holds

  const Intrinsics& depthCamera() const { return is_registered ? picture : depth; }
};

/// As the log has it. None for a fisheye lens, one of more than five numbers, or a camera without a calibration.
std::optional<DepthCamera> cameraOf(const mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace omnimapper::calibration

#pragma once

#include <mrpt/img/TCamera.h>

#include <optional>

namespace omnimapper::drivers {

/// A direction in the optical frame, as the point where it meets the plane z = 1: x right, y down.
struct NormalizedPoint {
  double x, y;
};

/// The point at which the lens images a direction: OpenCV's model (plumb_bob), as in its page "Camera Calibration and
/// 3D Reconstruction".
NormalizedPoint distort(const mrpt::img::TCamera& camera, NormalizedPoint direction);

/// The direction that the lens images at a point, the inverse of distort(). None if there is none.
std::optional<NormalizedPoint> undistort(const mrpt::img::TCamera& camera, NormalizedPoint image);

}  // namespace omnimapper::drivers

#pragma once

#include <mrpt/img/TCamera.h>

#include <optional>

namespace omnimapper::drivers {

/// On the plane at the distance 1: x right, y down.
struct NormalizedPoint {
  double x, y;
};

/// Where a lens images a direction: OpenCV's model (plumb_bob), as in its page "Camera Calibration and 3D
/// Reconstruction".
NormalizedPoint distort(const mrpt::img::TCamera& camera, NormalizedPoint direction);

/// The direction that a lens images there; none where it images none.
std::optional<NormalizedPoint> undistort(const mrpt::img::TCamera& camera, NormalizedPoint image);

}  // namespace omnimapper::drivers

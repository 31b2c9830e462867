#pragma once

#include <mrpt/img/TCamera.h>

#include <Eigen/Core>
#include <optional>

namespace omnimapper::live {

/// Where a lens images the direction (x, y, 1), on a plane at the distance 1: OpenCV's model (plumb_bob), as in its
/// page "Camera Calibration and 3D Reconstruction".
Eigen::Vector2d throughLens(const mrpt::img::TCamera& camera, const Eigen::Vector2d& direction);

/// The direction that a lens images there; none where it images none.
std::optional<Eigen::Vector2d> beforeLens(const mrpt::img::TCamera& camera, const Eigen::Vector2d& image);

}  // namespace omnimapper::live

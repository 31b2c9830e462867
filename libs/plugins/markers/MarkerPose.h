#pragma once

#include <omnimapper/camera/LensModel.h>
#include <omnimapper/geometry/Se3.h>

#include <optional>

namespace omnimapper::perception::markers {

/// Pose of a marker. The marker's frame: origin in its centre, x to its right, y to its top, z out of its front.
struct MarkerPose {
  geometry::Se3 optical_from_marker;
  Eigen::Matrix3d covariance_of_middle;  ///< [m^2] along the axes of the optical frame
};

/// Estimates a marker's pose by least squares of the reprojection errors of its four corners. For a square seen from
/// afar two poses may fit (Collins, Bartoli: Infinitesimal plane-based pose estimation, 2014): the better one is
/// returned. `side` [m], `corner_sigma` [px]. None if the corners are not those of a square in front of the camera.
std::optional<MarkerPose> poseOfMarker(const camera::LensModel& lens, const camera::Corners& in_image, double side,
                                       double corner_sigma);

}  // namespace omnimapper::perception::markers

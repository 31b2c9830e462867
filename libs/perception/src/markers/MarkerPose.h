#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/perception/LensModel.h>

#include <optional>

namespace omnimapper::perception::markers {

/// Where a marker is. Its frame: origin in its middle, x to its right, y to its top, z out of its picture.
struct MarkerPose {
  geometry::Se3 optical_from_marker;
  Eigen::Matrix3d covariance_of_middle;  ///< [m^2] along the axes of the optical frame
};

/// The pose whose four corners are seen nearest to those in the image, by least squares; of the two that a square seen
/// from afar may have, the one that fits better (Collins, Bartoli: Infinitesimal plane-based pose estimation, 2014).
/// `side` [m], `corner_sigma` [px]. None where the corners are of no square before the camera.
std::optional<MarkerPose> poseOfMarker(const LensModel& lens, const Corners& in_image, double side,
                                       double corner_sigma);

}  // namespace omnimapper::perception::markers

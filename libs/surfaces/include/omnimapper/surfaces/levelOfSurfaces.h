#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// A flat area that was seen, in any fixed frame.
struct FlatArea {
  Eigen::Vector3d normal;  ///< unit, towards the side from which the area was seen
  Eigen::Vector3d middle;  ///< [m]
  double area = 0;         ///< [m^2]
  int measurements = 1;    ///< number of measurements of the area
};

/// Pose of a camera that took an image, in the same frame.
struct Viewpoint {
  Eigen::Vector3d position;  ///< [m]
  Eigen::Vector3d up;        ///< unit, up in the camera's image
  Eigen::Vector3d forward;   ///< unit, along the optical axis
};

/// The direction of up that the surfaces of a place determine.
struct SurfacesLevel {
  std::optional<Eigen::Vector3d> up;  ///< unit; none if it cannot be determined
  /// Covariance of the rotation vector that takes the true up to `up` [rad^2].
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double margin = 0;   ///< natural logarithm of the odds of `up` against the best other direction
  std::string reason;  ///< half a sentence that explains `up`, or why it is none
};

/// The direction for which most surfaces are level or upright. Candidates are the normals, the cross products of
/// normals and, for places with a single wall, the mean up direction of the images, projected onto each surface. In a
/// room with right angles three axes explain the surfaces equally well. An axis among them is more likely if surfaces
/// at several heights face along it (floor, table tops), if the camera moved little along it, and if it is up in most
/// images. The chosen axis is refined by least squares with Tukey's loss, so that a ramp among walls does not count.
/// `up` is none if two directions are about equally likely, or if the tilt of the best direction is not determined (a
/// single wall). Areas below 0.1 m^2, and areas and viewpoints with invalid numbers, are left out.
SurfacesLevel levelOfSurfaces(const std::vector<FlatArea>& areas, const std::vector<Viewpoint>& viewpoints);

}  // namespace omnimapper::surfaces

#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// A flat area that was seen, in any frame that holds still.
struct FlatArea {
  Eigen::Vector3d normal;  ///< unit, to the side that it was seen from
  Eigen::Vector3d middle;  ///< [m]
  double area = 0;         ///< [m^2]
  int measurements = 1;    ///< how often it was seen
};

/// From where a camera looked, in the same frame.
struct Viewpoint {
  Eigen::Vector3d position;  ///< [m]
  Eigen::Vector3d up;        ///< unit: up in its picture
  Eigen::Vector3d forward;   ///< unit
};

/// Which way is up as the surfaces of a place tell.
struct SurfacesLevel {
  std::optional<Eigen::Vector3d> up;  ///< unit; none where it cannot be told
  /// Of the rotation vector that takes the true up to `up` [rad^2].
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double margin = 0;   ///< natural logarithm of the odds against the best direction that is another one
  std::string reason;  ///< half a sentence, in both cases
};

/// The direction for which most surfaces are level or upright. Candidates are the normals and the cross products of
/// normals. In a room of right angles three axes explain the surfaces alike: among them those count for more to which
/// level surfaces at several heights face (floor, table tops), along which the camera moved least, and which are up in
/// most pictures. The chosen one is refined by least squares with Tukey's loss, so that a ramp among walls does not
/// count. None where two directions are about as likely, or where nothing tells how far it leans (a single wall).
/// Areas and viewpoints that are not finite are left out.
SurfacesLevel levelOfSurfaces(const std::vector<FlatArea>& areas, const std::vector<Viewpoint>& viewpoints);

}  // namespace omnimapper::surfaces

#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/obs/CDerivedObservation.h>
#include <omnimapper/obs/Rgb.h>

#include <optional>
#include <vector>

namespace omnimapper::obs {

/// One flat part of a surface.
struct ObservedPlane {
  geometry::Plane3 plane_in_sensor;  ///< distance >= 0: the normal points to where the sensor is
  /// Covariance of the two changes of the normal [rad] and of the change of the distance [m], as
  /// geometry/PlaneTangent.h defines them. It includes the noise of the points and, as far as the extractor's options
  /// state them, errors that all points share, such as those of a wrong calibration. Shared errors are the same in all
  /// observations of one sensor.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m] mean of its points, on the plane
  geometry::Polygon3 outline;                          ///< [m] on the plane; may be concave
  std::vector<geometry::Polygon3> holes;               ///< [m] within the outline
  std::uint32_t inliers = 0;                           ///< number of its points
  double rms = 0;                                      ///< [m] root mean square distance of its points from the plane
  /// Scatter of its points about the plane divided by the sensor's noise [-]; 0 if not known.
  double roughness = 0;
  std::optional<Rgb> colour;  ///< mean, if the sensor has colours
};

/// The planes that were found in one depth image or point cloud.
class CObservationPlanes : public CDerivedObservation {
  DEFINE_SERIALIZABLE(CObservationPlanes, omnimapper::obs)

 public:
  std::vector<ObservedPlane> planes;

  std::string exportTxtHeader() const override;
  std::string exportTxtDataRow() const override;

 protected:
  void describe(std::ostream& out) const override;
  /// Draws each plane in a colour by its index: a translucent area, outline and holes as lines, the normal as an arrow.
  void draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const override;
};

}  // namespace omnimapper::obs

#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/obs/CDerivedObservation.h>
#include <omnimapper/obs/Rgb.h>

#include <optional>
#include <vector>

namespace omnimapper::obs {

/// One flat stretch of a surface.
struct ObservedPlane {
  geometry::Plane3 plane_in_sensor;  ///< distance >= 0: the normal points to where the sensor is
  /// Of the two changes of the normal [rad] and that of the distance [m], as geometry/PlaneTangent.h defines them.
  /// By the noise of its points, and by what they share, such as a wrong calibration, as far as the extractor was told
  /// of it. The latter is alike in all observations of one sensor.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m] mean of its points, on the plane
  geometry::Polygon3 outline;                          ///< [m] on the plane; may be concave
  std::vector<geometry::Polygon3> holes;               ///< [m] within the outline
  std::uint32_t inliers = 0;                           ///< number of its points
  double rms = 0;                                      ///< [m] distance of its points from the plane
  /// By how many times more than the sensor's noise its points scatter about the plane [-]; 0 where nobody told.
  double roughness = 0;
  std::optional<Rgb> colour;  ///< mean, where the sensor sees colours
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
  /// Each plane in a colour by its index: translucent where it is, its outline and holes as lines, its normal as arrow.
  void draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const override;
};

}  // namespace omnimapper::obs

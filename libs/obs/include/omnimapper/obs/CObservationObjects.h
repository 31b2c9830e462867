#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/obs/CDerivedObservation.h>
#include <omnimapper/obs/Rgb.h>

#include <optional>
#include <vector>

namespace omnimapper::obs {

/// An object: a cluster of points that belong to no plane.
struct ObservedObject {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the centroid [m^2]
  geometry::Se3 sensor_from_box;                         ///< middle and axes of the oriented box
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();    ///< [m] whole length along each axis of the box
  std::vector<Eigen::Vector3f> points;                   ///< [m] its points, or a selection of them
  std::vector<Rgb> colours;                              ///< one for each point, or none at all
  /// Index of the plane that it stands on, in the CObservationPlanes of the same source and stamp.
  std::optional<std::uint32_t> supporting_plane;
  std::optional<Rgb> colour;  ///< mean
  std::string class_label;    ///< empty: not known
  double score = 0;           ///< of the class label, 0 to 1
};

/// The objects that were found in one depth image or point cloud.
class CObservationObjects : public CDerivedObservation {
  DEFINE_SERIALIZABLE(CObservationObjects, omnimapper::obs)

 public:
  std::vector<ObservedObject> objects;

  std::string exportTxtHeader() const override;
  std::string exportTxtDataRow() const override;

 protected:
  void describe(std::ostream& out) const override;
  /// Draws box and points in a colour by index (points in their own colour if they have one), and the class label above
  /// the box.
  void draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const override;
};

}  // namespace omnimapper::obs

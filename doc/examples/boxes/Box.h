#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/plugin/Association.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace boxes {

struct BoxOptions : omnimapper::mapper::AssociationOptions {
  double min_score = 0.3;  ///< of the class, below which the class counts as unknown
  double sigma = 0.05;     ///< [m] of the middle of a box, in addition to what the detector reports

  static const omnimapper::base::OptionTable<BoxOptions>& table();
};

/// The measurement: the box around an object that a detector found.
struct Box {
  omnimapper::geometry::Se3 base_from_box;  ///< middle and axes of the box
  Eigen::Vector3d size;                     ///< [m] along each axis of the box
  Eigen::Matrix3d covariance;               ///< of the middle in the base [m^2]
  std::string class_label;                  ///< empty: unknown
  double score;                             ///< of the class label, 0 to 1
};

/// The boxes of an observation, in its order.
std::vector<Box> boxesOf(const omnimapper::obs::CObservationObjects& observation, const BoxOptions& options);

/// Whether two classes may be that of one object: they are equal, or one is unknown.
bool mayBeOne(const std::string& class_label, const std::string& other);

}  // namespace boxes

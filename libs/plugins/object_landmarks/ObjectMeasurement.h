#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/obs/CObservationObjects.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "ObjectLandmarksOptions.h"
#include "ObjectPayload.h"

namespace omnimapper::plugins {

/// An object as one image shows it. Frame: the base.
struct ObjectMeasurement {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();      ///< [m] of its box
  Eigen::Vector3d size = Eigen::Vector3d::Zero();        ///< [m] of its box
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2] of `middle`
  ObjectView view;
  std::string class_label;  ///< empty: unknown
  double score = 0;
  std::string sensor_label;
  std::optional<ObjectPicture> picture;
  std::string why_useless;  ///< empty if it can be used
};

/// [m^2] How uncertain the middle of a box is because each view shows another part of the object: along each axis of
/// the box, `share` of its side. A view may miss up to a half of the object, so that the middle is within a quarter of
/// the side; of an error that is uniform there the standard deviation is 0.14 of the side.
Eigen::Matrix3d covarianceOfPart(const Eigen::Matrix3d& axes, const Eigen::Vector3d& size, double share);

/// The objects of an observation that are used, the largest first. `pictures`: of the observation's objects, in its
/// order; may be empty. `dropped` counts those beyond Options::max_per_image.
std::vector<ObjectMeasurement> objectMeasurements(const obs::CObservationObjects& observation, base::KeyFrameId frame,
                                                  const std::vector<std::optional<ObjectPicture>>& pictures,
                                                  const ObjectLandmarksOptions& options, std::size_t& dropped);

}  // namespace omnimapper::plugins

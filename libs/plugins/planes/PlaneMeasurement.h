#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/Noise.h>
#include <omnimapper/plane_factors/PlaneParametrization.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <memory>
#include <string>
#include <vector>

#include "PlaneLandmarksOptions.h"

namespace omnimapper::plugins {

/// One plane of a depth image or cloud, or one line of a laser, as a measurement of a plane landmark. All geometry is
/// in the frame of the base.
struct PlaneMeasurement {
  bool is_line = false;
  std::string sensor_label;
  geometry::Plane3 plane_in_base;  ///< for a line, the upright plane through it
  /// [m] The convex hull of a plane or, with boundary = seen, its measured outline. For a line, its two ends.
  std::vector<Eigen::Vector3d> outline_in_base;
  std::vector<std::vector<Eigen::Vector3d>> holes_in_base;  ///< [m] only with boundary = seen
  /// With boundary = seen, the parts that were seen from near and not too obliquely. Empty if all of the plane was seen
  /// so, or nothing of it.
  std::vector<surfaces::FlatPart> well_seen_in_base;
  bool is_all_well_seen = true;
  double roughness = 0;  ///< as ObservedPlane::roughness
  double size = 0;       ///< area of the hull [m^2]; for a line, its length [m]
  std::shared_ptr<const graph::Factor> factor;
  graph::SquareRootInformation noise = graph::SquareRootInformation::identity(1);
  std::string why_useless;  ///< if not empty, only is_line, sensor_label and size are valid
};

/// All planes or lines of an observation, in the observation's order. `up_in_base`: unit vector up, for the upright
/// planes through lines.
std::vector<PlaneMeasurement> planeMeasurements(const mrpt::obs::CObservation& observation,
                                                const Eigen::Vector3d& up_in_base,
                                                const plane_factors::PlaneParametrization& form,
                                                const PlaneLandmarksOptions& options);

/// Covariance of a plane in its tangent [rad, rad, m], increased because the real surface is not quite flat: by
/// angle_sigma [rad] and distance_sigma [m] at `middle`, the middle of the measured points [m]. All values are in one
/// frame.
Eigen::Matrix3d withRoughness(const geometry::Plane3& plane, const Eigen::Matrix3d& covariance,
                              const Eigen::Vector3d& middle, double angle_sigma, double distance_sigma);

}  // namespace omnimapper::plugins

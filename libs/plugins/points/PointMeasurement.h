#pragma once

#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/Noise.h>
#include <omnimapper/plugin/Motion.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "PointLandmarksOptions.h"

namespace omnimapper::plugins {

/// The factor and noise with which a range-bearing measurement binds a point landmark.
struct PointConstraint {
  Eigen::Vector3d point_in_base;  ///< [m]
  double sigma;                   ///< [m] of the point, along the least certain direction
  std::shared_ptr<const graph::Factor> factor;
  graph::SquareRootInformation noise;
};

/// One measurement of an observation.
struct PointMeasurement {
  std::int32_t number;  ///< of the landmark; -1 if the sensor does not report one
  double range;         ///< [m]
  std::optional<PointConstraint> constraint;
  std::string why_useless;  ///< the reason, if there is no constraint
};

/// All measurements of an observation, in the observation's order.
std::vector<PointMeasurement> pointMeasurements(const mrpt::obs::CObservationBearingRange& observation,
                                                mapper::Motion motion, const PointLandmarksOptions& options);

}  // namespace omnimapper::plugins

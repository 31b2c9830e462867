#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/RelativeMotion.h>

#include <memory>
#include <string>

namespace omnimapper::mapper {

// Conversions between the poses that plugins use and the variables and factors of the graph: SE(2) in a planar map,
// where z, roll and pitch are left out, and SE(3) in a spatial one.

/// Kind of the pose variables of a map with this motion.
std::shared_ptr<const graph::Variable> poseVariable(Motion motion);
/// The value of a pose variable, as the graph stores it.
Eigen::VectorXd poseValue(Motion motion, const mrpt::poses::CPose3D& map_from_base);
/// The pose that a variable holds.
mrpt::poses::CPose3D poseOf(const graph::Graph& graph, base::VariableId id);

/// Factor for a measured motion from pose `begin` to pose `end`. Variances below (0.1 mm)^2 and (0.001 deg)^2 are
/// raised to these values. If a covariance is not positive definite, only its diagonal is used.
graph::FactorRecord betweenPoses(Motion motion, base::VariableId begin, base::VariableId end,
                                 const RelativeMotion& measured, const std::string& owner);
/// Factor for a measured pose in the map; `covariance` is in the tangent at the pose and is treated as in
/// betweenPoses().
graph::FactorRecord posePrior(Motion motion, base::VariableId pose, const mrpt::poses::CPose3D& map_from_base,
                              const Eigen::Matrix<double, 6, 6>& covariance, const std::string& owner);

}  // namespace omnimapper::mapper

#include "ScanFactor.h"

#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>

namespace omnimapper::plugins {

mapper::RelativeMotion scanMotion(const LoopClosureOptions& options, const matching::ScanMatch& match) {
  const auto squared = [](double value) { return value * value; };
  Eigen::Matrix3d planar_covariance =
      match.unit_covariance *
      std::max(squared(options.point_sigma), squared(options.wall_sigma_factor * match.wall_distance));
  planar_covariance.diagonal() += Eigen::Vector3d(
      squared(options.position_sigma_floor), squared(options.position_sigma_floor), squared(options.angle_sigma_floor));
  return planarMotion(match.reference_from_scan, planar_covariance);
}

graph::FactorRecord scanFactor(const LoopClosureOptions& options, const mapper::PluginContext& context,
                               base::VariableId reference, base::VariableId scan, const matching::ScanMatch& match) {
  return mapper::betweenPoses(context.motion, reference, scan, scanMotion(options, match), context.section);
}

}  // namespace omnimapper::plugins

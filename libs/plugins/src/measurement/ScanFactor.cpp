#include "ScanFactor.h"

#include <mrpt/poses/CPose2D.h>
#include <omnimapper/mapper/PoseFactors.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

mapper::RelativeMotion planarMotion(const TPose2D& begin_from_end, const Eigen::Matrix3d& covariance) {
  mapper::RelativeMotion motion;
  motion.begin_from_end = mrpt::poses::CPose3D(mrpt::poses::CPose2D(begin_from_end));
  // A scan says nothing of height and tilt: a metre and half a radian, in a spatial map.
  motion.covariance = Eigen::Matrix<double, 6, 6>::Zero();
  motion.covariance.diagonal() << 0, 0, 1.0, 0.25, 0.25, 0;
  const std::array<int, 3> index{0, 1, 5};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      motion.covariance(index[row], index[column]) = covariance(row, column);
    }
  }
  return motion;
}

graph::FactorRecord scanFactor(const LoopClosureOptions& options, const mapper::PluginContext& context,
                               base::VariableId reference, base::VariableId scan, const matching::ScanMatch& match) {
  const auto squared = [](double value) { return value * value; };
  Eigen::Matrix3d planar_covariance =
      match.unit_covariance *
      std::max(squared(options.point_sigma), squared(options.wall_sigma_factor * match.wall_distance));
  planar_covariance.diagonal() += Eigen::Vector3d(
      squared(options.position_sigma_floor), squared(options.position_sigma_floor), squared(options.angle_sigma_floor));
  return mapper::betweenPoses(context.motion, reference, scan,
                              planarMotion(match.reference_from_scan, planar_covariance), context.section);
}

}  // namespace omnimapper::plugins

#include "ScanFactor.h"

#include <mrpt/poses/CPose2D.h>
#include <omnimapper/mapper/PoseFactors.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

mapper::Decision judge(const matching::ScanMatch& match, const TPose2D& guess, const MatchGate& gate) {
  const TPose2D correction = match.reference_from_scan - guess;
  const double moved = std::hypot(correction.x, correction.y);
  const double turned = std::abs(mrpt::math::wrapToPi(correction.phi));
  mapper::Decision decision;
  decision.numbers = {{"overlap", match.overlap},
                      {"distance from walls [m]", match.wall_distance},
                      {"correction [m]", moved},
                      {"correction [deg]", turned / base::option_text::kRadiansPerDegree}};
  if (match.overlap < gate.min_overlap) {
    decision.reason = "too little overlap";
  } else if (moved > gate.max_correction) {
    decision.reason = "too far from the prediction";
  } else if (turned > gate.max_turn_correction) {
    decision.reason = "turned too far from the prediction";
  } else {
    decision.accepted = true;
    decision.reason = "matched";
  }
  return decision;
}

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

graph::FactorRecord scanFactor(const ScanMatchingOptions& options, double position_floor, double angle_floor,
                               const mapper::PluginContext& context, base::VariableId reference, base::VariableId scan,
                               const matching::ScanMatch& match) {
  const auto squared = [](double value) { return value * value; };
  Eigen::Matrix3d planar_covariance =
      match.unit_covariance *
      std::max(squared(options.point_sigma), squared(options.wall_sigma_factor * match.wall_distance));
  planar_covariance.diagonal() +=
      Eigen::Vector3d(squared(position_floor), squared(position_floor), squared(angle_floor));
  return mapper::betweenPoses(context.motion, reference, scan,
                              planarMotion(match.reference_from_scan, planar_covariance), context.section);
}

}  // namespace omnimapper::plugins

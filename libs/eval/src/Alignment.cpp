#include <omnimapper/base/Error.h>
#include <omnimapper/eval/Alignment.h>

#include <Eigen/SVD>

#include "NamedChoice.h"

namespace omnimapper::eval {

namespace {

// Positions of all pairs relative to their means, one column each.
struct CentredPositions {
  Eigen::Vector3d estimate_mean = Eigen::Vector3d::Zero(), reference_mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd estimate, reference;

  explicit CentredPositions(const std::vector<PosePair>& pairs)
      : estimate(3, pairs.size()), reference(3, pairs.size()) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      estimate.col(i) = pairs[i].estimate.translation;
      reference.col(i) = pairs[i].reference.translation;
    }
    estimate_mean = estimate.rowwise().mean();
    reference_mean = reference.rowwise().mean();
    centre(estimate, estimate_mean);
    centre(reference, reference_mean);
  }

 private:
  // Sets rounding errors to zero; those of a body that stands still would be taken for a direction of motion.
  static void centre(Eigen::Matrix3Xd& positions, const Eigen::Vector3d& mean) {
    const double rounding = 1e-13 * (1 + mean.norm());
    positions.colwise() -= mean;
    positions = positions.unaryExpr([=](double v) { return std::abs(v) < rounding ? 0.0 : v; });
  }
};

// The rotation about z that brings the centred estimate nearest to the centred reference.
Eigen::Quaterniond fitYaw(const CentredPositions& positions) {
  const Eigen::Matrix3d moments = positions.reference * positions.estimate.transpose();
  const double sine = moments(1, 0) - moments(0, 1);
  const double cosine = moments(0, 0) + moments(1, 1);
  return geometry::expSo3({0, 0, std::atan2(sine, cosine)});
}

struct Turn {
  Eigen::Quaterniond rotation;
  double gain;  // sum over all pairs of reference . R estimate, both centred
};

// Umeyama's rotation, from the singular vectors of the moments; the smallest one is flipped if they would mirror.
Turn fitRotation(const CentredPositions& positions) {
  const Eigen::Matrix3d moments = positions.reference * positions.estimate.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d singular = svd.singularValues();
  if (singular[0] == 0) return {Eigen::Quaterniond::Identity(), 0};
  if (singular[1] < 1e-12 * singular[0]) {  // on a line: the turn about it is free
    return {Eigen::Quaterniond::FromTwoVectors(svd.matrixV().col(0), svd.matrixU().col(0)), singular[0]};
  }
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1;
  const Eigen::DiagonalMatrix<double, 3> mirror_free(1, 1, sign);
  const Eigen::Matrix3d rotation = svd.matrixU() * mirror_free * svd.matrixV().transpose();
  return {Eigen::Quaterniond(rotation).normalized(), singular[0] + singular[1] + sign * singular[2]};
}

// The similarity with that rotation and scale that maps mean to mean.
Similarity about(const CentredPositions& positions, const Eigen::Quaterniond& rotation, double scale) {
  return {scale, {rotation, positions.reference_mean - scale * (rotation * positions.estimate_mean)}};
}

}  // namespace

Eigen::Vector3d operator*(const Similarity& reference_from_estimate, const Eigen::Vector3d& p_in_estimate) {
  return reference_from_estimate.motion.translation +
         reference_from_estimate.scale * (reference_from_estimate.motion.rotation * p_in_estimate);
}

geometry::Se3 operator*(const Similarity& reference_from_estimate, const geometry::Se3& estimate_from_body) {
  return {(reference_from_estimate.motion.rotation * estimate_from_body.rotation).normalized(),
          reference_from_estimate * estimate_from_body.translation};
}

Alignment alignmentNamed(const std::string& name) {
  return namedChoice<Alignment>(name, "alignment",
                                {{"none", Alignment::none},
                                 {"first", Alignment::first},
                                 {"yaw", Alignment::yaw},
                                 {"se3", Alignment::se3},
                                 {"sim3", Alignment::sim3}});
}

Similarity fitAlignment(const std::vector<PosePair>& pairs, Alignment alignment) {
  if (pairs.empty()) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "no pose of the estimate is paired with one of the reference: there is nothing to align");
  }
  if (alignment == Alignment::none) return {};
  if (alignment == Alignment::first) return {1, pairs.front().reference * inverse(pairs.front().estimate)};
  const CentredPositions positions(pairs);
  if (alignment == Alignment::yaw) return about(positions, fitYaw(positions), 1);
  const Turn turn = fitRotation(positions);
  if (alignment == Alignment::se3) return about(positions, turn.rotation, 1);
  const double estimate_spread = positions.estimate.squaredNorm();
  if (!(estimate_spread > 0) || !(turn.gain > 0)) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "estimate or reference never moves, so no scale can be fitted; use --align se3");
  }
  return about(positions, turn.rotation, turn.gain / estimate_spread);
}

std::vector<PosePair> aligned(std::vector<PosePair> pairs, const Similarity& reference_from_estimate) {
  for (auto& pair : pairs) pair.estimate = reference_from_estimate * pair.estimate;
  return pairs;
}

}  // namespace omnimapper::eval

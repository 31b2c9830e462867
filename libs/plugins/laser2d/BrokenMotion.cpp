#include "BrokenMotion.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "EvidenceText.h"

namespace omnimapper::plugins {

namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Standard deviations of the position, in the best and the worst direction [m].
Eigen::Vector2d positionSigmas(const Matrix6d& covariance) {
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(position).eigenvalues().cwiseMax(0).cwiseSqrt();
}

// Whether the factors between two key frames leave open how the base moved.
bool isBroken(const map::KeyFrame& before, const map::KeyFrame& after, const graph::Graph& graph) {
  bool is_linked = false;
  for (const auto id : graph.factorsOf(after.pose)) {
    const auto& record = graph.factor(id);
    const bool is_link = record.variables == std::vector<base::VariableId>{before.pose, after.pose};
    if (!is_link || record.weight <= 0 || record.tags.hypothesis) continue;
    // x and y are the first two directions of a planar and of a spatial pose.
    const Eigen::Matrix2d information = record.noise.information().topLeftCorner<2, 2>();
    if (information.trace() > 8 / (kBrokenPosition * kBrokenPosition)) return false;
    is_linked = true;
  }
  return is_linked;
}

}  // namespace

bool isWeakMotion(const Matrix6d& covariance) {
  constexpr double kWeakPosition = 0.15, kWeakYaw = 0.035;  // [m] [rad]
  return positionSigmas(covariance)[1] > kWeakPosition || std::sqrt(covariance(5, 5)) > kWeakYaw;
}

bool isBrokenMotion(const Matrix6d& covariance) {
  return positionSigmas(covariance)[0] > 0.5 * kBrokenPosition;
}

std::vector<mapper::Evidence> brokenMotions(const mapper::State& state) {
  constexpr double kFound = 0.5;  // [m] standard deviation to which closures must have found out the motion
  std::vector<mapper::Evidence> all;
  const map::KeyFrame* before = nullptr;
  double begun = 0;
  const auto& frames = state.map.key_frames;
  for (const auto& frame : frames) {
    const bool continues = before && before->id.session == frame.id.session;
    if (continues)
      begun += base::secondsBetween(before->stamp, frame.stamp);
    else
      begun = 0;
    if (continues && isBroken(*before, frame, state.graph)) {
      const auto covariance = state.covarianceBetween(before->id, frame.id);
      const double after = begun - base::secondsBetween(before->stamp, frame.stamp);
      if (covariance && positionSigmas(*covariance)[1] < kFound) {
        const auto motion = frame.map_from_base - before->map_from_base;
        all.push_back({kBrokenAfter, after, mapper::Evidence::Says::good,
                       evidenceText("%s the base was moved by %.1f m while no scan came and the wheels stood, which "
                                    "closures found out",
                                    afterStart(state.map, *before).c_str(), motion.norm())});
      } else {
        all.push_back({kBrokenAfter, after, mapper::Evidence::Says::against_it,
                       evidenceText("%s scans and wheels contradict each other across a gap: the base was moved by "
                                    "hand, and where to is not known",
                                    afterStart(state.map, *before).c_str())});
      }
    }
    before = &frame;
  }
  return all;
}

}  // namespace omnimapper::plugins

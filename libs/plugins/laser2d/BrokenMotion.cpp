#include "BrokenMotion.h"

#include <omnimapper/geometry/SymmetricEigen.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "EvidenceText.h"
#include "PlanarMotion.h"

namespace omnimapper::plugins {

namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Standard deviations of the position, in the best and the worst direction [m].
Eigen::Vector2d positionSigmas(const Matrix6d& covariance) {
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  return geometry::eigenvaluesOf<2>(position).cwiseMax(0).cwiseSqrt();
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

// The gap between two key frames: the stamp at which the longest time without a scan begins.
base::Stamp gapBetween(const map::KeyFrame& before, const map::KeyFrame& after) {
  base::Stamp reached = before.stamp, begin = reached;
  base::Duration longest{};
  const auto take = [&](base::Stamp stamp) {
    if (stamp - reached > longest) {
      longest = stamp - reached;
      begin = reached;
    }
    reached = stamp;
  };
  for (const auto& dependent : before.dependents) take(dependent.stamp);
  take(after.stamp);
  return begin;
}

}  // namespace

bool UsualMotion::isWeak(const Matrix6d& covariance) {
  constexpr double kWeakPosition = 0.15, kWeakYaw = 0.035;  // [m] [rad] at least
  constexpr double kUnusual = 3;                            // times the usual
  constexpr double kKept = 0.98;
  const double position = positionSigmas(covariance)[1], yaw = std::sqrt(covariance(5, 5));
  const bool is_first = yaw_ == 0;
  const bool is_weak = !is_first && (position > std::max(kWeakPosition, kUnusual * position_) ||
                                     yaw > std::max(kWeakYaw, kUnusual * yaw_));
  const auto learn = [&](double& usual, double sigma) {
    usual = is_first ? sigma : kKept * usual + (1 - kKept) * std::min(sigma, kUnusual * usual);
  };
  learn(position_, position);
  learn(yaw_, yaw);
  return is_weak;
}

bool isBrokenMotion(const Matrix6d& covariance) {
  return positionSigmas(covariance)[0] > 0.5 * kBrokenPosition;
}

std::vector<mapper::Evidence> brokenMotions(const mapper::State& state) {
  constexpr double kFound = 0.5;  // [m] standard deviation to which closures must have found out the motion
  std::vector<mapper::Evidence> all;
  const map::KeyFrame *first = nullptr, *before = nullptr;
  for (const auto& frame : state.map.key_frames) {
    if (!first || first->id.session != frame.id.session) first = before = &frame;
    const map::KeyFrame& from = *std::exchange(before, &frame);
    if (&from == &frame || !isBroken(from, frame, state.graph)) continue;
    const double seconds = base::secondsBetween(first->stamp, gapBetween(from, frame));
    const auto covariance = state.covarianceBetween(from.id, frame.id);
    mapper::Evidence evidence{kBrokenAfter, seconds, mapper::Evidence::Says::against_it, ""};
    const double moved =
        distanceBetween(planar(frame.map_from_base - from.map_from_base), planar(from.keyframe_from_next)).metres;
    if (covariance && positionSigmas(*covariance)[1] < kFound) {
      if (moved < kFound) continue;  // the wheels were right
      evidence.says = mapper::Evidence::Says::good;
      evidence.reason =
          evidenceText("%.0f s after the start the base was carried by %.1f m, as closures have found out", seconds,
                       (frame.map_from_base - from.map_from_base).norm());
    } else {
      evidence.reason = evidenceText(
          "%.0f s after the start the base was carried across a gap in the scans, and "
          "nothing has shown where to",
          seconds);
    }
    all.push_back(std::move(evidence));
  }
  return all;
}

}  // namespace omnimapper::plugins

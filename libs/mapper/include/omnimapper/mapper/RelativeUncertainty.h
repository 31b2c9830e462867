#pragma once

#include <omnimapper/graph/Marginals.h>
#include <omnimapper/mapper/View.h>

#include <Eigen/Core>
#include <optional>

namespace omnimapper::mapper {

/// How well one key frame is known from another, for gates. The graph is factored once after a solve, when first asked;
/// key frames that came later are reached by the factors along the trajectory.
class RelativeUncertainty {
 public:
  /// Covariance of inverse(map_from_base of `from`) * map_from_base of `to`: tangent at `to`, x y z [m], rotation
  /// vector [rad]; zeros outside x, y, yaw in a planar map. `from` must be older than `to`. None while a direction of
  /// some variable is determined by nothing.
  std::optional<Eigen::Matrix<double, 6, 6>> between(const View& view, base::KeyFrameId from, base::KeyFrameId to);

 private:
  bool update(const View& view);

  std::optional<graph::Marginals> marginals_;
  std::size_t solves_ = 0;   // of the engine, when they were made
  std::size_t covered_ = 0;  // key frames in them
};

}  // namespace omnimapper::mapper

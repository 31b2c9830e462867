#pragma once

#include <omnimapper/interaction/PointingTarget.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::interaction {

/// How likely a gesture is if it is aimed at a point, or in a direction from the hand.
class PointingLikelihood {
 public:
  PointingLikelihood(const PointingGesture& gesture, const PointingModel& model, const TargetOptions& options);

  /// Whether a ray is known. Without one, nothing can be said.
  bool isKnown() const { return !rays_.empty(); }

  /// Probability per solid angle [1/sr] of the corrected direction of pointing, if `target` is aimed at. A gesture
  /// that means no target has the same in each direction.
  double towards(const Eigen::Vector3d& target) const;

  /// Directions from the hand, of which each stands for the solid angle `weight` [sr], where towards() is not small.
  struct Direction {
    Eigen::Vector3d unit;
    double weight;
  };
  std::vector<Direction> directions() const;

 private:
  struct Ray {
    Eigen::Vector3d ahead;  // unit
    RayErrors PointingRow::*errors;
  };
  // The error of a direction in one angle, of both rays together.
  struct Residual {
    double value, variance;
  };
  Residual residualOf(const PointingRow& row, const std::vector<PointingError>& errors, bool is_theta) const;
  // The direction in which the rays point after correction.
  Eigen::Vector3d corrected() const;

  const PointingGesture& gesture_;
  const PointingModel& model_;
  double freedom_, side_;
  std::vector<Ray> rays_;
};

}  // namespace omnimapper::interaction

#pragma once

#include <Eigen/Core>

namespace omnimapper::sim {

/// Angles by which a pointing ray misses its target, as in section 6.1 of the thesis: the direction of the target from
/// the hand, in a frame with z along the ray. The thesis does not fix the other two axes where the ray turns far from
/// the sensor's; here they follow from what it says about its tables in 6.1.6.2 (elbow-hand "to the left" with negative
/// theta and "above" with positive psi; head-hand "below" with negative psi): x is level and to the left of the ray, y
/// downwards across it, for a map with z up.
struct PointingError {
  double theta = 0;  ///< [rad]; negative: the ray passes to the left of the target, seen along the ray
  double psi = 0;    ///< [rad]; positive: the ray passes above the target
};

/// Theta = atan2(x, z), psi = atan2(y, z) of the target. `direction` need not be unit, and must not be vertical.
PointingError pointingErrorOf(const Eigen::Vector3d& hand, const Eigen::Vector3d& direction,
                              const Eigen::Vector3d& target);

/// The unit direction of a ray from the hand that has this error. If there is none, because the target is almost
/// vertically above or below the hand, the one that comes nearest in theta.
Eigen::Vector3d directionWithError(const Eigen::Vector3d& hand, const Eigen::Vector3d& target,
                                   const PointingError& error);

}  // namespace omnimapper::sim

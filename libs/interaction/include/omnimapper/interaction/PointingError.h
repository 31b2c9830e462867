#pragma once

#include <Eigen/Core>

namespace omnimapper::interaction {

/// Angles by which a pointing ray misses its target, as in section 6.1 of the thesis: they give the direction of the
/// target from the hand, in a frame with z along the ray. For rays that point far away from the axes of the sensor, the
/// thesis does not say how the other two axes lie. Here they follow from what it says about its tables in 6.1.6.2
/// (elbow-hand "to the left" with negative theta and "above" with positive psi; head-hand "below" with negative psi).
/// For a map with z up, x is level and points to the left of the ray, and y points downwards, perpendicular to the ray.
struct PointingError {
  double theta = 0;  ///< [rad]; negative: the ray passes to the left of the target, seen along the ray
  double psi = 0;    ///< [rad]; positive: the ray passes above the target
};

/// Theta = atan2(x, z), psi = atan2(y, z) of the target. `direction` need not be unit, and must not be vertical.
PointingError pointingErrorOf(const Eigen::Vector3d& hand, const Eigen::Vector3d& direction,
                              const Eigen::Vector3d& target);

/// The unit direction of a ray from the hand that has this error. If no direction has this error, because the target is
/// almost vertically above or below the hand, returns the direction that comes nearest in theta.
Eigen::Vector3d directionWithError(const Eigen::Vector3d& hand, const Eigen::Vector3d& target,
                                   const PointingError& error);

}  // namespace omnimapper::interaction

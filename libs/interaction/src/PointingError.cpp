#include <omnimapper/interaction/PointingError.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace omnimapper::interaction {

PointingError pointingErrorOf(const Eigen::Vector3d& hand, const Eigen::Vector3d& direction,
                              const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = direction.normalized(), x = Eigen::Vector3d(-z.y(), z.x(), 0).normalized(),
                        y = x.cross(z);  // downwards: x is to the left
  const Eigen::Vector3d to_target = target - hand;
  return {std::atan2(to_target.dot(x), to_target.dot(z)), std::atan2(to_target.dot(y), to_target.dot(z))};
}

// theta and psi are the errors of the direction in two planes. With the target's unit direction t,
//   t.z : t.x : t.y = 1 : tan(theta) : tan(psi).
// The axis x depends on the ray's azimuth a alone:
//   t.x = cos(elevation of t) sin(azimuth of t - a).
// A turn by psi in the vertical plane of the ray then remains.
Eigen::Vector3d directionWithError(const Eigen::Vector3d& hand, const Eigen::Vector3d& target,
                                   const PointingError& error) {
  const Eigen::Vector3d t = (target - hand).normalized();
  const double tan_theta = std::tan(error.theta), tan_psi = std::tan(error.psi);
  const double along = 1 / std::sqrt(1 + tan_theta * tan_theta + tan_psi * tan_psi);
  const double level = t.head<2>().norm();
  const double sine = level > 0 ? std::clamp(along * tan_theta / level, -1.0, 1.0) : 0.0;
  const double azimuth = std::atan2(t.y(), t.x()) - std::asin(sine);
  const double elevation = std::atan2(t.z(), level * std::sqrt(1 - sine * sine)) + error.psi;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

}  // namespace omnimapper::interaction

#pragma once

#include <omnimapper/geometry/Plane3.h>

#include <Eigen/Core>

namespace omnimapper::plane_factors {

/// Two axes on a plane. If the plane is tilted from level by more than 26 degrees, the first axis is level and the
/// second axis points up; else the first axis points along the x axis of the map.
struct PlaneAxes {
  explicit PlaneAxes(const geometry::Plane3& plane);

  Eigen::Vector2d onto(const Eigen::Vector3d& point) const { return {u.dot(point - foot), v.dot(point - foot)}; }
  Eigen::Vector3d inSpace(const Eigen::Vector2d& point) const { return foot + u * point.x() + v * point.y(); }

  Eigen::Vector3d foot;  ///< the plane's point nearest to the origin [m]
  Eigen::Vector3d u, v;  ///< unit, u x v = normal
};

}  // namespace omnimapper::plane_factors

#pragma once

#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception::objects {

struct OrientedBox {
  geometry::Se3 frame_from_box;                    ///< middle and axes
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< [m] whole length along each axis
};

/// Points [m], with one array for each coordinate.
struct PointList {
  std::vector<float> x, y, z;

  std::size_t size() const { return z.size(); }
  Eigen::Vector3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void push_back(const Eigen::Vector3f& point) {
    x.push_back(point.x());
    y.push_back(point.y());
    z.push_back(point.z());
  }
};

/// The box around the points whose z axis is the unit vector `axis` and whose base has the least area; x is along the
/// longer side of the base. There must be at least one point.
OrientedBox boxAlong(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points);

/// The smallest box with the axes of `box` that encloses `box` and all of the points.
OrientedBox extended(const OrientedBox& box, const PointList& points);

}  // namespace omnimapper::perception::objects

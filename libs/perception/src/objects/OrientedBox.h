#pragma once

#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception::objects {

struct OrientedBox {
  geometry::Se3 frame_from_box;  ///< middle and axes
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
};

/// The box around the points with one side along the unit vector `axis`, which becomes its z, and of the others the
/// least area; x is the longer of them. One point at least.
OrientedBox boxAlong(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points);

/// The box with the same axes around a box and all of the points.
OrientedBox extended(const OrientedBox& box, const std::vector<Eigen::Vector3f>& points);

}  // namespace omnimapper::perception::objects

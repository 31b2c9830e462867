#pragma once

#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception::objects {

/// The corners of the convex hull, counter-clockwise; points on its edges are left out. Source: Andrew's monotone
/// chain.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

/// Whether the point lies within a convex hull, or at most `margin` outside of each of its edges.
bool isNearHull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point, double margin);

struct OrientedBox {
  geometry::Se3 frame_from_box;  ///< middle and axes
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
};

/// The box around the points with one side along the unit vector `axis`, which becomes its z, and of the others the
/// least area; x is the longer of them. One point at least.
OrientedBox boxAlong(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points);

}  // namespace omnimapper::perception::objects

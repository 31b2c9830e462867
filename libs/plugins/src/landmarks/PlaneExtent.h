#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/map/KeyFrames.h>

#include <Eigen/Core>
#include <vector>

#include "PlanePayload.h"

namespace omnimapper::plugins {

/// Two axes on a plane. Of one that leans from level by more than 26 degrees the first is level and the second leads
/// up; of others the first goes along the x of the map.
struct PlaneAxes {
  explicit PlaneAxes(const geometry::Plane3& plane);

  Eigen::Vector2d onto(const Eigen::Vector3d& point) const { return {u.dot(point - foot), v.dot(point - foot)}; }
  Eigen::Vector3d inSpace(const Eigen::Vector2d& point) const { return foot + u * point.x() + v * point.y(); }

  Eigen::Vector3d foot;  ///< the plane's point nearest to the origin [m]
  Eigen::Vector3d u, v;  ///< unit, u x v = normal
};

/// The convex hull of points, dropped on a plane [m, PlaneAxes].
std::vector<Eigen::Vector2d> hullOn(const PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points);

/// The outlines of what the patches of planes cover together, dropped on a plane [m, PlaneAxes]; lines cover nothing.
std::vector<std::vector<Eigen::Vector2d>> seenOn(const PlaneAxes& axes, const std::vector<SurfacePatch>& patches,
                                                 const map::KeyFrames& key_frames);

/// The corners of patches in the map, each where its key frame is now.
std::vector<Eigen::Vector3d> cornersInMap(const std::vector<SurfacePatch>& patches, const map::KeyFrames& key_frames);

}  // namespace omnimapper::plugins

#include "PlaneExtent.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/PolygonUnion.h>

#include <Eigen/Geometry>
#include <cmath>

namespace omnimapper::plugins {

PlaneAxes::PlaneAxes(const geometry::Plane3& plane) : foot(-plane.distance * plane.normal) {
  constexpr double kLevel = 0.9;  // a normal this upright is that of a floor or a table
  const bool level = std::abs(plane.normal.z()) > kLevel;
  const Eigen::Vector3d across =
      level ? Eigen::Vector3d::UnitY().cross(plane.normal).eval() : Eigen::Vector3d::UnitZ().cross(plane.normal).eval();
  u = across.normalized();
  v = plane.normal.cross(u);
}

std::vector<Eigen::Vector2d> hullOn(const PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> dropped;
  dropped.reserve(points.size());
  for (const auto& point : points) dropped.push_back(axes.onto(point));
  return geometry::convexHull(std::move(dropped));
}

std::vector<std::vector<Eigen::Vector2d>> seenOn(const PlaneAxes& axes, const std::vector<SurfacePatch>& patches,
                                                 const map::KeyFrames& key_frames) {
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  for (const auto& patch : patches) {
    auto& polygon = polygons.emplace_back();
    for (const auto& corner : cornersInMap({patch}, key_frames)) polygon.push_back(axes.onto(corner));
  }
  return geometry::unionOf(polygons);
}

std::vector<Eigen::Vector3d> cornersInMap(const std::vector<SurfacePatch>& patches, const map::KeyFrames& key_frames) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& patch : patches) {
    const auto map_from_base = geometry::fromMrpt(key_frames.at(patch.frame).map_from_base);
    for (const auto& corner : patch.outline_in_base) corners.push_back(map_from_base * corner);
  }
  return corners;
}

}  // namespace omnimapper::plugins

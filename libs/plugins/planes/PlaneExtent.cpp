#include "PlaneExtent.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/PolygonUnion.h>

namespace omnimapper::plugins {

std::vector<Eigen::Vector2d> hullOn(const landmarks::PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> dropped;
  dropped.reserve(points.size());
  for (const auto& point : points) dropped.push_back(axes.onto(point));
  return geometry::convexHull(std::move(dropped));
}

std::vector<std::vector<Eigen::Vector2d>> seenOn(const landmarks::PlaneAxes& axes,
                                                 const std::vector<SurfacePatch>& patches,
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

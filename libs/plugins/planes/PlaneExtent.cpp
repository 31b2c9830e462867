#include "PlaneExtent.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <Eigen/Geometry>

namespace omnimapper::plugins {

std::vector<Eigen::Vector2d> hullOn(const plane_factors::PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> dropped;
  dropped.reserve(points.size());
  for (const auto& point : points) dropped.push_back(axes.onto(point));
  return geometry::convexHull(std::move(dropped));
}

geometry::Areas2 seenOn(const plane_factors::PlaneAxes& axes, const std::vector<SurfacePatch>& patches,
                        const map::KeyFrames& key_frames) {
  constexpr double kLeast =
      0.02;  // [m^2] smaller holes and islands come from edges that are seen differently each time
  std::vector<geometry::HoledPolygon2> polygons;
  for (const auto& patch : patches) {
    const auto map_from_base = geometry::fromMrpt(key_frames.at(patch.frame).map_from_base);
    const auto dropped = [&](const std::vector<Eigen::Vector3d>& walk) {
      std::vector<Eigen::Vector2d> points;
      for (const auto& corner : walk) points.push_back(axes.onto(map_from_base * corner));
      return points;
    };
    auto& polygon = polygons.emplace_back();
    polygon.outline = dropped(patch.outlineInBase());
    for (const auto& hole : patch.holesInBase()) polygon.holes.push_back(dropped(hole));
  }
  return geometry::unionOf(polygons, kLeast);
}

double extentOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  return points.empty() ? 0 : box.diagonal().norm();
}

void addSeen(surfaces::CellGrid& cells, const geometry::Plane3& plane, const std::vector<SurfacePatch>& patches,
             const map::KeyFrames& key_frames) {
  const auto corners = cornersInMap(patches, key_frames);
  auto all = corners;
  if (cells.columns() > 0) {
    all.push_back(cells.middleOf({0, 0}));
    all.push_back(cells.middleOf({cells.columns() - 1, cells.rows() - 1}));
  }
  if (!(extentOf(all) < kLargestCounted)) return;
  cells = cells.grownTo(plane, corners, kSeenCell);
  for (const auto& patch : patches) {
    const auto map_from_base = geometry::fromMrpt(key_frames.at(patch.frame).map_from_base);
    const auto inMap = [&](std::vector<Eigen::Vector3d> walk) {
      for (auto& corner : walk) corner = map_from_base * corner;
      return walk;
    };
    std::vector<std::vector<Eigen::Vector3d>> holes;
    for (const auto& hole : patch.holesInBase()) holes.push_back(inMap(hole));
    cells.fill(inMap(patch.outlineInBase()), holes);
  }
}

std::vector<Eigen::Vector3d> cornersInMap(const std::vector<SurfacePatch>& patches, const map::KeyFrames& key_frames) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& patch : patches) {
    const auto map_from_base = geometry::fromMrpt(key_frames.at(patch.frame).map_from_base);
    for (const auto& corner : patch.outlineInBase()) corners.push_back(map_from_base * corner);
  }
  return corners;
}

}  // namespace omnimapper::plugins

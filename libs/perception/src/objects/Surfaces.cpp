#include "Surfaces.h"

#include <omnimapper/geometry/PlaneTangent.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::perception::objects {

namespace {

double areaOf(const PlaneRegion& plane) {
  double result = geometry::area(plane.outline.polygon_in_sensor);
  for (const Contour& hole : plane.holes) result -= geometry::area(hole.polygon_in_sensor);
  return result;
}

bool areCoplanar(const PlaneRegion& a, const PlaneRegion& b, const ObjectOptions& options, double distortion_at_1m) {
  if (a.plane_in_sensor.normal.dot(b.plane_in_sensor.normal) < std::cos(options.coplanar_angle)) return false;
  const double depth = std::max(a.centroid.z(), b.centroid.z());
  const double farthest = options.coplanar_distance + distortion_at_1m * depth * depth;
  return std::abs(signedDistance(a.plane_in_sensor, b.centroid)) <= farthest &&
         std::abs(signedDistance(b.plane_in_sensor, a.centroid)) <= farthest;
}

HullNeighbourhood hullOf(const PlaneSegmentation& planes, const Surface& surface) {
  std::vector<Eigen::Vector2d> points;
  for (const int piece : surface.pieces) {
    for (const auto& vertex : planes.planes[static_cast<std::size_t>(piece)].outline.polygon_in_sensor.vertices)
      points.emplace_back(surface.across.transpose() * vertex);
  }
  return HullNeighbourhood(convexHull(std::move(points)));
}

}  // namespace

std::vector<Surface> findSurfaces(const PlaneSegmentation& planes, const ObjectOptions& options,
                                  double distortion_at_1m, const Eigen::Vector3d& up) {
  std::vector<Surface> surfaces;
  std::vector<bool> taken(planes.planes.size(), false);
  for (std::size_t i = 0; i < planes.planes.size(); ++i) {
    const PlaneRegion& largest = planes.planes[i];
    if (taken[i] || largest.plane_in_sensor.normal.dot(up) < std::cos(options.max_tilt)) continue;
    Surface surface;
    surface.plane = static_cast<int>(i);
    surface.pieces.push_back(surface.plane);
    double area = areaOf(largest);
    for (std::size_t j = i + 1; j < planes.planes.size(); ++j) {
      if (taken[j] || !areCoplanar(largest, planes.planes[j], options, distortion_at_1m)) continue;
      surface.pieces.push_back(static_cast<int>(j));
      area += areaOf(planes.planes[j]);
    }
    if (area < options.min_surface_area) continue;
    for (const int piece : surface.pieces) taken[static_cast<std::size_t>(piece)] = true;
    surface.across = geometry::tangentBasis(largest.plane_in_sensor.normal);
    surface.hull = hullOf(planes, surface);
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

std::vector<std::uint8_t> labelsOfThePlace(const PlaneSegmentation& planes, const ObjectOptions& options,
                                           double distortion_at_1m, const std::vector<Surface>& surfaces) {
  std::vector<std::uint8_t> of_place(planes.planes.size() + 1, 0);
  for (const PlaneRegion& large : planes.planes) {
    if (areaOf(large) < options.min_surface_area) continue;
    for (std::size_t i = 0; i < planes.planes.size(); ++i) {
      const PlaneRegion& piece = planes.planes[i];
      if (&piece == &large || areCoplanar(large, piece, options, distortion_at_1m)) of_place[i + 1] = 1;
    }
  }
  for (const Surface& surface : surfaces) {
    for (const int piece : surface.pieces) of_place[static_cast<std::size_t>(piece) + 1] = 1;
  }
  return of_place;
}

std::vector<geometry::Plane3> uprightPlanesOfThePlace(const PlaneSegmentation& planes,
                                                      const std::vector<std::uint8_t>& of_place,
                                                      const std::vector<Surface>& surfaces) {
  std::vector<std::uint8_t> is_upright = of_place;
  for (const Surface& surface : surfaces) {
    for (const int piece : surface.pieces) is_upright[static_cast<std::size_t>(piece) + 1] = 0;
  }
  std::vector<geometry::Plane3> upright;
  for (std::size_t i = 0; i < planes.planes.size(); ++i) {
    if (is_upright[i + 1] != 0) upright.push_back(planes.planes[i].plane_in_sensor);
  }
  return upright;
}

}  // namespace omnimapper::perception::objects

#include "PlaneLandmarkIndex.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace omnimapper::plugins {

namespace {

constexpr double kUpright = 0.2;  // z of the normal

struct Interval {
  double low, high;
};

Interval alongFloor(const std::vector<Eigen::Vector2d>& hull) {
  const auto [low, high] =
      std::minmax_element(hull.begin(), hull.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return {low->x(), high->x()};
}

}  // namespace

void PlaneLandmarkIndex::restore(const mapper::View& view) {
  for (const auto id : view.candidates(owner())) {
    const auto* payload = dynamic_cast<const PlanePayload*>(view.map.landmark(id).payload.get());
    if (payload && payload->form == empty_.form) continue;
    const std::string there = !payload ? "landmarks of another kind"
                              : payload->form == plane_factors::PlaneParametrization::Kind::wall
                                  ? "landmarks of form = wall"
                                  : "landmarks of form = plane";
    throw base::Error(
        base::ExitCode::out_of_range,
        "[" + owner() + "] the map has " + there +
            " under this name; give the section the settings that the map was made with, or another name");
  }
  LandmarkIndex::restore(view);
}

void LandmarkSurface::refresh(const map::Landmark& landmark, const mapper::View& view) {
  KnownLandmark::refresh(landmark, view);
  const auto& now = dynamic_cast<const PlanePayload&>(*landmark.payload);
  const auto on = plane_factors::PlaneParametrization::of(now.form).plane(view.graph.value(variable));
  const bool is_solved = solve != view.solves.size() + 1;
  // Between solves only whole sessions move, and patches are only added.
  const bool is_placed = on.normal != plane.normal || on.distance != plane.distance;
  if (payload == landmark.payload && !is_solved && !is_placed) return;
  plane = on;
  if (is_solved || is_placed || patches > now.patches.size()) forgetExtent();
  if (patches < now.patches.size()) addPatches(now, view.map.key_frames);
  Eigen::Vector2d middle_on_plane = Eigen::Vector2d::Zero();
  for (const auto& corner : hull) middle_on_plane += corner / static_cast<double>(hull.size());
  radius = 0;
  for (const auto& corner : hull) radius = std::max(radius, (corner - middle_on_plane).norm());
  middle = plane_factors::PlaneAxes(plane).inSpace(middle_on_plane);
  heights = now.wasSeenAsPlane() ? Heights::known : Heights::unknown;
  last_seen_from = now.last_seen_from;
  payload = landmark.payload;
  solve = view.solves.size() + 1;
}

void LandmarkSurface::forgetExtent() {
  patches = 0;
  hull.clear();
  seen = {};
  well_seen = {};
  std::tie(lowest, highest) = std::pair(HUGE_VAL, -HUGE_VAL);
}

void LandmarkSurface::addPatches(const PlanePayload& now, const map::KeyFrames& key_frames) {
  const std::vector<SurfacePatch> fresh(now.patches.begin() + static_cast<std::ptrdiff_t>(patches), now.patches.end());
  patches = now.patches.size();
  auto corners = cornersInMap(fresh, key_frames);
  const auto [low, high] = heightsOf(corners);
  lowest = std::min(lowest, low);
  highest = std::max(highest, high);
  const plane_factors::PlaneAxes axes(plane);
  for (const auto& corner : hull) corners.push_back(axes.inSpace(corner));
  hull = hullOn(axes, corners);
  std::vector<SurfacePatch> fresh_well_seen;
  std::copy_if(fresh.begin(), fresh.end(), std::back_inserter(fresh_well_seen),
               [](const SurfacePatch& patch) { return patch.is_well_seen; });
  addSeen(seen, plane, fresh, key_frames);
  addSeen(well_seen, plane, fresh_well_seen, key_frames);
}

std::pair<double, double> heightsOf(const std::vector<Eigen::Vector3d>& points) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  return points.empty() ? std::pair(0.0, 0.0) : std::pair(low->z(), high->z());
}

double gapBetween(const LandmarkSurface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
                  LandmarkSurface::Heights of_points) {
  using Heights = LandmarkSurface::Heights;
  const auto hull = hullOn(plane_factors::PlaneAxes(surface.plane), points_in_map);
  const bool known = surface.heights == Heights::known && of_points == Heights::known;
  if (known || std::abs(surface.plane.normal.z()) > kUpright) return geometry::distance(surface.hull, hull);
  const Interval a = alongFloor(surface.hull), b = alongFloor(hull);
  return std::max({0.0, b.low - a.high, a.low - b.high});
}

// Each lies in a ball about its middle, and the gap is at least the distance of the middles less both radii. Only the
// part of the distance along the plane counts, and of upright surfaces only that along the floor.
double gapAtLeast(const LandmarkSurface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
                  const Eigen::Vector3d& middle) {
  double radius = 0;
  for (const auto& point : points_in_map) radius = std::max(radius, (point - middle).norm());
  const Eigen::Vector3d from = middle - surface.middle;
  const Eigen::Vector3d& normal = surface.plane.normal;
  Eigen::Vector3d along = from - normal.dot(from) * normal;
  if (std::abs(normal.z()) <= kUpright) {
    const Eigen::Vector3d along_floor = Eigen::Vector3d::UnitZ().cross(normal).normalized();
    along = along_floor.dot(from) * along_floor;
  }
  return along.norm() - surface.radius - radius;
}

}  // namespace omnimapper::plugins

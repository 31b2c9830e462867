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

void PlaneLandmarkIndex::restore(const mapper::State& state) {
  for (const auto id : state.candidates(owner_)) {
    const auto* payload = dynamic_cast<const PlanePayload*>(state.map.landmark(id).payload.get());
    if (!payload || payload->form != empty_.form) {
      const std::string there = !payload ? "landmarks of another kind"
                                : payload->form == landmarks::PlaneParametrization::Kind::wall
                                    ? "landmarks of form = wall"
                                    : "landmarks of form = plane";
      throw base::Error(
          base::ExitCode::out_of_range,
          "[" + owner_ + "] the map has " + there +
              " under this name; give the section the settings that the map was made with, or another name");
    }
    add(id);
  }
}

void PlaneLandmarkIndex::update(const mapper::View& view) {
  for (auto at = surfaces_.begin(); at != surfaces_.end();) {
    Surface& surface = at->second;
    const map::Landmark* landmark = view.map.landmarks.find(surface.id);
    if (!landmark || landmark->state != map::Landmark::State::active) {
      at = surfaces_.erase(at);
      continue;
    }
    ++at;
    const auto plane = form().plane(view.graph.value(landmark->variables.front()));
    const bool is_solved = surface.solve != view.solves.size() + 1;
    // Between solves only whole sessions move, and patches are only added.
    const bool is_placed = plane.normal != surface.plane.normal || plane.distance != surface.plane.distance;
    if (surface.payload == landmark->payload && !is_solved && !is_placed) continue;
    const auto& payload = dynamic_cast<const PlanePayload&>(*landmark->payload);
    surface.variable = landmark->variables.front();
    surface.plane = plane;
    const landmarks::PlaneAxes axes(surface.plane);
    const bool has_moved = is_solved || is_placed || surface.patches > payload.patches.size();
    if (has_moved) {
      surface.patches = 0;
      surface.hull.clear();
      surface.seen = {};
      surface.well_seen = {};
      std::tie(surface.lowest, surface.highest) = std::pair(HUGE_VAL, -HUGE_VAL);
    }
    const std::vector<SurfacePatch> fresh(payload.patches.begin() + static_cast<std::ptrdiff_t>(surface.patches),
                                          payload.patches.end());
    surface.patches = payload.patches.size();
    if (!fresh.empty()) {
      auto corners = cornersInMap(fresh, view.map.key_frames);
      const auto [lowest, highest] = heightsOf(corners);
      surface.lowest = std::min(surface.lowest, lowest);
      surface.highest = std::max(surface.highest, highest);
      for (const auto& corner : surface.hull) corners.push_back(axes.inSpace(corner));
      surface.hull = hullOn(axes, corners);
      std::vector<SurfacePatch> fresh_well_seen;
      std::copy_if(fresh.begin(), fresh.end(), std::back_inserter(fresh_well_seen),
                   [](const SurfacePatch& patch) { return patch.is_well_seen; });
      addSeen(surface.seen, surface.plane, fresh, view.map.key_frames);
      addSeen(surface.well_seen, surface.plane, fresh_well_seen, view.map.key_frames);
    }
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const auto& corner : surface.hull) middle += corner / static_cast<double>(surface.hull.size());
    surface.radius = 0;
    for (const auto& corner : surface.hull) surface.radius = std::max(surface.radius, (corner - middle).norm());
    surface.middle = axes.inSpace(middle);
    surface.heights = payload.wasSeenAsPlane() ? Heights::known : Heights::unknown;
    surface.last_seen_from = payload.last_seen_from;
    surface.payload = landmark->payload;
    surface.solve = view.solves.size() + 1;
  }
}

std::pair<double, double> heightsOf(const std::vector<Eigen::Vector3d>& points) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  return points.empty() ? std::pair(0.0, 0.0) : std::pair(low->z(), high->z());
}

double gapBetween(const PlaneLandmarkIndex::Surface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
                  PlaneLandmarkIndex::Heights of_points) {
  using Heights = PlaneLandmarkIndex::Heights;
  const auto hull = hullOn(landmarks::PlaneAxes(surface.plane), points_in_map);
  const bool known = surface.heights == Heights::known && of_points == Heights::known;
  if (known || std::abs(surface.plane.normal.z()) > kUpright) return geometry::distance(surface.hull, hull);
  const Interval a = alongFloor(surface.hull), b = alongFloor(hull);
  return std::max({0.0, b.low - a.high, a.low - b.high});
}

// Each lies in a ball about its middle, and the gap is at least the distance of the middles less both radii. Only the
// part of the distance along the plane counts, and of upright surfaces only that along the floor.
double gapAtLeast(const PlaneLandmarkIndex::Surface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
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

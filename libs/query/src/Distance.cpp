#include <omnimapper/query/Distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace omnimapper::query {

namespace {

using Eigen::Vector2d;
using Walk = std::vector<Vector2d>;

// By the even-odd rule.
bool isInside(const Walk& walk, const Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = walk.size() - 1; i < walk.size(); j = i++) {
    const Vector2d &a = walk[i], &b = walk[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

Vector2d nearestOnLine(const Vector2d& from, const Vector2d& to, const Vector2d& point) {
  const Vector2d along = to - from;
  const double length = along.squaredNorm();
  if (!(length > 0)) return from;
  return from + std::clamp((point - from).dot(along) / length, 0.0, 1.0) * along;
}

// A point on an island in a hole lies in more outlines than holes.
bool isInside(const map::Extent& extent, const Vector2d& point) {
  const auto count = [&](const std::vector<Walk>& walks) {
    return std::count_if(walks.begin(), walks.end(), [&](const Walk& walk) { return isInside(walk, point); });
  };
  return count(extent.outlines) > count(extent.holes);
}

template <class Visit>
void forEachLine(const map::Extent& extent, Visit visit) {
  for (const auto& line : extent.lines) visit(line.first, line.second);
  for (const auto* walks : {&extent.outlines, &extent.holes})
    for (const Walk& walk : *walks)
      for (std::size_t i = 0, j = walk.size() - 1; i < walk.size(); j = i++) visit(walk[j], walk[i]);
}

}  // namespace

std::optional<Vector2d> nearestPoint(const map::Extent& extent, const Vector2d& point) {
  if (isInside(extent, point)) return point;
  std::optional<Vector2d> nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vector2d& candidate) {
    const double distance = (candidate - point).norm();
    if (!(distance < least)) return;
    least = distance;
    nearest = candidate;
  };
  for (const auto& each : extent.points) consider(each);
  forEachLine(extent, [&](const Vector2d& from, const Vector2d& to) { consider(nearestOnLine(from, to, point)); });
  return nearest;
}

std::vector<Vector2d> rimOf(const map::Extent& extent, double step) {
  constexpr double kMost = 1000;
  double length = 0;
  forEachLine(extent, [&](const Vector2d& from, const Vector2d& to) { length += (to - from).norm(); });
  const double spacing = std::max(step, length / kMost);
  std::vector<Vector2d> rim = extent.points;
  forEachLine(extent, [&](const Vector2d& from, const Vector2d& to) {
    const double parts = std::max(1.0, std::ceil((to - from).norm() / spacing));
    for (double i = 0; i <= parts; ++i) rim.emplace_back(from + i / parts * (to - from));
  });
  return rim;
}

std::vector<NearPlace> nearestPlaces(const std::vector<map::Place>& places, const Vector2d& point, double within,
                                     std::size_t most) {
  std::vector<NearPlace> near;
  for (const auto& place : places) {
    const auto nearest = nearestPoint(place.extent, point);
    if (!nearest) continue;
    const double distance = (*nearest - point).norm();
    if (distance <= within) near.push_back({&place, distance});
  }
  std::sort(near.begin(), near.end(), [](const NearPlace& a, const NearPlace& b) {
    return std::tie(a.distance, a.place->id) < std::tie(b.distance, b.place->id);
  });
  if (near.size() > most) near.resize(most);
  return near;
}

}  // namespace omnimapper::query

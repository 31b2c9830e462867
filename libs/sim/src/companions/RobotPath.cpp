#include "RobotPath.h"

#include <omnimapper/geometry/Se3.h>

#include <algorithm>

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

// The shake of a hand-held base adds no distance, because knots are farther apart than it reaches [m].
constexpr double kSpacing = 0.05;
constexpr double kDirectionReach = 0.4;  // [m]

Vector2d headingOf(const geometry::Se3& map_from_base) {
  const Vector2d ahead = (map_from_base.rotation * Eigen::Vector3d::UnitX()).head<2>();
  return ahead.norm() > 1e-6 ? Vector2d(ahead.normalized()) : Vector2d(1, 0);
}

}  // namespace

RobotPath::RobotPath(const Track& map_from_base) : map_from_base_(map_from_base) {
  const auto& places = map_from_base_.places();
  for (const Track::Place& place : places) {
    const Vector2d in_map = place.map_from_body->translation.head<2>();
    const double moved = knots_.empty() ? 0 : (in_map - knots_.back().in_map).norm();
    const bool is_last = &place == &places.back();
    if (!knots_.empty() && moved < kSpacing && !(is_last && moved > 0)) continue;
    knots_.push_back({place.time, knots_.empty() ? 0 : knots_.back().travel + moved, in_map});
  }
  first_heading_ = headingOf(*places.front().map_from_body);
  last_heading_ = headingOf(*places.back().map_from_body);
}

Vector2d RobotPath::robotAt(double time) const {
  return map_from_base_.at(time)->translation.head<2>();
}

double RobotPath::travelAt(double time) const {
  const auto after =
      std::upper_bound(knots_.begin(), knots_.end(), time, [](double t, const Knot& knot) { return t < knot.time; });
  if (after == knots_.begin()) return 0;
  if (after == knots_.end()) return length();
  const Knot& before = *(after - 1);
  return std::min(before.travel + (robotAt(time) - before.in_map).norm(), after->travel);
}

Vector2d RobotPath::pointAt(double travel) const {
  if (travel <= 0) return knots_.front().in_map + travel * first_heading_;
  if (travel >= length()) return knots_.back().in_map + (travel - length()) * last_heading_;
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), travel,
                                      [](double t, const Knot& knot) { return t < knot.travel; });
  const Knot &from = *(after - 1), &to = *after;
  const double share = (travel - from.travel) / (to.travel - from.travel);
  return from.in_map + share * (to.in_map - from.in_map);
}

Vector2d RobotPath::directionAt(double travel) const {
  const Vector2d across = pointAt(travel + kDirectionReach) - pointAt(travel - kDirectionReach);
  if (across.norm() > 0.1) return across.normalized();
  // The line turns back here; the direction is that in which it goes on.
  const Vector2d ahead = pointAt(travel + kDirectionReach) - pointAt(travel);
  return ahead.norm() > 1e-6 ? Vector2d(ahead.normalized()) : last_heading_;
}

std::vector<double> RobotPath::passings(const Vector2d& point, double reach) const {
  std::vector<double> travels;
  const Knot* nearest = nullptr;
  const auto distanceOf = [&](const Knot& knot) { return (knot.in_map - point).norm(); };
  for (const Knot& knot : knots_) {
    const bool is_near = distanceOf(knot) <= reach;
    if (is_near && (!nearest || distanceOf(knot) < distanceOf(*nearest))) nearest = &knot;
    if (!is_near && nearest) travels.push_back(nearest->travel), nearest = nullptr;
  }
  if (nearest) travels.push_back(nearest->travel);
  return travels;
}

}  // namespace omnimapper::sim

#include "Walk.h"

#include <omnimapper/geometry/Angle.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

constexpr double kLift = 0.07;         // of a foot in the middle of its swing [m]
constexpr double kHeadingReach = 0.3;  // a heading is that of the path from this far behind to this far ahead [m]

bool isBefore(const PersonSpec::Waypoint& waypoint, double time) {
  return waypoint.time < time;
}

double headingOf(const Eigen::Vector2d& travel) {
  return std::atan2(travel.y(), travel.x());
}

}  // namespace

Walk::Walk(const std::vector<PersonSpec::Waypoint>& waypoints, double half_hips, double step)
    : waypoints_(waypoints), half_hips_(half_hips) {
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const double length = (waypoints[i + 1].in_map - waypoints[i].in_map).norm();
    if (length == 0) continue;
    if (runs_.empty() || runs_.back().end() != waypoints[i].time) {
      runs_.push_back({{waypoints[i]}, {0}, 1, headingOf(waypoints[i + 1].in_map - waypoints[i].in_map)});
    }
    runs_.back().waypoints.push_back(waypoints[i + 1]);
    runs_.back().along.push_back(runs_.back().along.back() + length);
  }
  for (Run& run : runs_) run.steps = std::max(1, static_cast<int>(std::lround(run.length() / step)));
}

double Walk::Run::travelAt(double time) const {
  if (time <= begin()) return 0;
  if (time > end()) return length();
  const auto after = std::lower_bound(waypoints.begin(), waypoints.end(), time, isBefore);
  const auto i = static_cast<std::size_t>(after - waypoints.begin()) - 1;
  const double share = (time - waypoints[i].time) / (waypoints[i + 1].time - waypoints[i].time);
  return along[i] + share * (along[i + 1] - along[i]);
}

Eigen::Vector2d Walk::Run::placeAt(double travel) const {
  const std::size_t after = std::clamp<std::size_t>(
      std::upper_bound(along.begin(), along.end(), travel) - along.begin(), 1, along.size() - 1);
  const double share = std::clamp((travel - along[after - 1]) / (along[after] - along[after - 1]), 0.0, 1.0);
  return waypoints[after - 1].in_map + share * (waypoints[after].in_map - waypoints[after - 1].in_map);
}

double Walk::Run::headingAt(double travel) const {
  const Eigen::Vector2d stretch = placeAt(travel + kHeadingReach) - placeAt(travel - kHeadingReach);
  if (stretch.norm() > 1e-3) return headingOf(stretch);
  return headingOf(placeAt(travel + 1e-3) - placeAt(travel - 1e-3));
}

Stance::Foot Walk::printOf(const Run& run, double travel, bool right) const {
  const double yaw = run.headingAt(travel), side = right ? -half_hips_ : half_hips_;
  return {run.placeAt(travel) + side * Eigen::Vector2d(-std::sin(yaw), std::cos(yaw)), yaw, 0};
}

// Swing j = 0 ... steps takes a foot, left and right in turn, to the end of step j + 1 while the body goes from half a
// step before the end of step j to half a step beyond it; so the body is in the middle between the feet when they
// change. The first swing begins and the last one ends beside the other foot.
Stance::Foot Walk::footAt(const Run& run, double travel, bool right) const {
  const double step = run.length() / run.steps;
  int before = -1;  // the last swing of this foot that has begun
  // Swings that begin more than two steps back have begun.
  const int past = std::max(0, static_cast<int>(travel / step) - 2), first = past - past % 2 + (right ? 1 : 0);
  for (int j = first; j <= run.steps && travel > std::max(0.0, (j - 0.5) * step); j += 2) before = j;
  if (before < 0) return printOf(run, 0, right);
  const double begin = std::max(0.0, (before - 0.5) * step), end = std::min(run.length(), (before + 0.5) * step);
  const double share = std::clamp((travel - begin) / (end - begin), 0.0, 1.0);
  const Stance::Foot from = printOf(run, std::max(0, before - 1) * step, right),
                     to = printOf(run, std::min(before + 1, run.steps) * step, right);
  const double eased = share * share * (3 - 2 * share);
  return {from.in_map + eased * (to.in_map - from.in_map), from.yaw + eased * geometry::wrapToPi(to.yaw - from.yaw),
          kLift * std::sin(M_PI * share)};
}

Stance Walk::at(double time) const {
  Stance stance;
  stance.body = waypoints_.front().in_map;
  const auto after = std::upper_bound(waypoints_.begin(), waypoints_.end(), time,
                                      [](double t, const PersonSpec::Waypoint& waypoint) { return t < waypoint.time; });
  if (after != waypoints_.begin()) stance.body = (after - 1)->in_map;
  if (!runs_.empty()) stance.heading = runs_.front().first_heading;
  const auto next =
      std::upper_bound(runs_.begin(), runs_.end(), time, [](double t, const Run& run) { return t < run.begin(); });
  if (next == runs_.begin()) return stance;
  const Run& run = *(next - 1);
  const double travel = run.travelAt(time);
  stance.heading = run.headingAt(travel);
  stance.walks = time < run.end();
  if (stance.walks) {
    stance.body = run.placeAt(travel);
    stance.left = footAt(run, travel, false);
    stance.right = footAt(run, travel, true);
  }
  return stance;
}

bool Walk::stands(double begin, double end) const {
  return std::none_of(runs_.begin(), runs_.end(),
                      [&](const Run& run) { return begin < run.end() && end > run.begin(); });
}

const double* Walk::headingSoon(double time, double ahead) const {
  const auto next =
      std::lower_bound(runs_.begin(), runs_.end(), time, [](const Run& run, double t) { return run.begin() < t; });
  return next != runs_.end() && next->begin() <= time + ahead ? &next->first_heading : nullptr;
}

}  // namespace omnimapper::sim

#include "DrivenMotion.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

constexpr double kLargestBlend = 1.0;  // [m] largest distance before and behind a corner over which it is rounded
constexpr double kSharpest = 10.0;  // [rad/m] angle over length of a blend; at sharper corners the robot turns in place
constexpr double kLargestCorner = 2.0;     // [rad] at larger corners the robot turns in place
constexpr double kKnotSpacing = 0.005;     // [m] on a blend
constexpr double kLineKnotSpacing = 0.05;  // [m] on a straight line

/// The rounding of a corner: a Bezier curve of degree 5 whose curvature is 0 at both ends.
class Blend {
 public:
  Blend(const Eigen::Vector2d& corner, const Eigen::Vector2d& into, const Eigen::Vector2d& out_of, double size) {
    constexpr double kOuter = 0.6, kInner = 0.3;  // gives an even curvature for corners of 30 to 110 degrees
    points_ = {corner - size * into,
               corner - kOuter * size * into,
               corner - kInner * size * into,
               corner + kInner * size * out_of,
               corner + kOuter * size * out_of,
               corner + size * out_of};
  }
  Eigen::Vector2d at(double share) const { return casteljau(points_, share); }
  Eigen::Vector2d first(double share) const { return casteljau(differences(points_), share); }
  Eigen::Vector2d second(double share) const { return casteljau(differences(differences(points_)), share); }
  const Eigen::Vector2d& begin() const { return points_.front(); }
  const Eigen::Vector2d& end() const { return points_.back(); }

 private:
  using Points = std::vector<Eigen::Vector2d>;
  static Points differences(const Points& points) {
    Points result;
    for (std::size_t i = 1; i < points.size(); ++i)
      result.push_back(static_cast<double>(points.size() - 1) * (points[i] - points[i - 1]));
    return result;
  }
  static Eigen::Vector2d casteljau(Points points, double share) {
    for (; points.size() > 1; points.pop_back()) {
      for (std::size_t i = 1; i < points.size(); ++i) points[i - 1] += share * (points[i] - points[i - 1]);
    }
    return points.front();
  }
  Points points_;
};

double yawOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

// The largest rounding of the corner that is free of obstacles; none if it would be too small to be driven.
std::optional<Blend> roundedCorner(const Eigen::Vector2d& before, const Eigen::Vector2d& corner,
                                   const Eigen::Vector2d& after, const RobotSpace& plan) {
  const Eigen::Vector2d into = (corner - before).normalized(), out_of = (after - corner).normalized();
  const double angle = std::abs(geometry::wrapToPi(yawOf(out_of) - yawOf(into)));
  if (angle > kLargestCorner) return std::nullopt;
  const double room = 0.5 * std::min((corner - before).norm(), (after - corner).norm());
  for (double size = std::min(kLargestBlend, room); size * kSharpest >= angle; size *= 0.75) {
    const Blend blend(corner, into, out_of, size);
    constexpr int kChecks = 40;
    bool free = true;
    for (int i = 0; i < kChecks && free; ++i)
      free = plan.isFree(blend.at(static_cast<double>(i) / kChecks), blend.at((i + 1.0) / kChecks));
    if (free) return blend;
  }
  return std::nullopt;
}

// Adds knots on a straight line; drive() sets their speeds and times.
template <class Knot>
void addLine(std::vector<Knot>& knots, const Eigen::Vector2d& to, double yaw) {
  const Eigen::Vector2d from = knots.back().position;
  const double length = (to - from).norm(), travel = knots.back().travel;
  if (length == 0) return;
  // A path from rest to rest needs a knot in between at which the robot moves.
  const int count = std::max(2, static_cast<int>(std::ceil(length / kLineKnotSpacing)));
  for (int i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    knots.push_back({from + share * (to - from), yaw, 0, travel + share * length, 0, 0});
  }
}

template <class Knot>
void addBlend(std::vector<Knot>& knots, const Blend& blend) {
  const double chord = (blend.end() - blend.begin()).norm();
  const int count = std::max(8, static_cast<int>(std::ceil(chord / kKnotSpacing)));
  for (int i = 1; i <= count; ++i) {
    const double from = (i - 1.0) / count, to = static_cast<double>(i) / count;
    // Length by Gauss-Legendre quadrature with three points.
    const double middle = 0.5 * (from + to), offset = 0.5 * (to - from) * std::sqrt(0.6);
    const double length = (to - from) / 18 *
                          (5 * blend.first(middle - offset).norm() + 8 * blend.first(middle).norm() +
                           5 * blend.first(middle + offset).norm());
    const Eigen::Vector2d first = blend.first(to), second = blend.second(to);
    const double curvature = (first.x() * second.y() - first.y() * second.x()) / std::pow(first.norm(), 3);
    const double yaw = knots.back().yaw + geometry::wrapToPi(yawOf(first) - knots.back().yaw);
    knots.push_back({blend.at(to), yaw, curvature, knots.back().travel + length, 0, 0});
  }
}

}  // namespace

DrivenMotion::DrivenMotion(const geometry::Se2& start, const MotionLimits& limits) : limits_(limits), end_(start) {}

void DrivenMotion::wait(double seconds) {
  if (seconds <= 0) return;
  legs_.push_back({duration_, {}, {duration_, seconds, end_.yaw, 0, end_.translation()}});
  duration_ += seconds;
}

void DrivenMotion::turn(double angle) {
  if (std::abs(angle) < 1e-9) return;
  const double size = std::abs(angle), ramp = limits_.turn * limits_.turn / limits_.turn_acceleration;
  const double seconds = size > ramp ? size / limits_.turn + limits_.turn / limits_.turn_acceleration
                                     : 2 * std::sqrt(size / limits_.turn_acceleration);
  legs_.push_back({duration_, {}, {duration_, seconds, end_.yaw, angle, end_.translation()}});
  duration_ += seconds;
  end_.yaw = geometry::wrapToPi(end_.yaw + angle);
}

void DrivenMotion::turnTo(double yaw) {
  turn(geometry::wrapToPi(yaw - end_.yaw));
}

void DrivenMotion::follow(const Polyline& corners, const RobotSpace& plan) {
  Polyline path;
  for (const Eigen::Vector2d& corner : corners) {
    if (path.empty() || (corner - path.back()).norm() > 1e-6) path.push_back(corner);
  }
  if (path.size() < 2) return;
  const auto startLeg = [&](std::size_t i) {
    turnTo(yawOf(path[i + 1] - path[i]));
    return std::vector<Knot>{{path[i], yawOf(path[i + 1] - path[i]), 0, 0, 0, 0}};
  };
  std::vector<Knot> knots = startLeg(0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double yaw = knots.back().yaw;
    if (i + 1 == path.size()) {
      addLine(knots, path[i], yaw);
      drive(std::move(knots));
    } else if (const auto blend = roundedCorner(path[i - 1], path[i], path[i + 1], plan)) {
      addLine(knots, blend->begin(), yaw);
      addBlend(knots, *blend);
    } else {
      addLine(knots, path[i], yaw);
      drive(std::move(knots));
      knots = startLeg(i);
    }
  }
}

// Finds the fastest speeds within the limits: those of each knot, then those that can be reached from the knots before
// and after it.
void DrivenMotion::drive(std::vector<Knot> knots) {
  const std::size_t count = knots.size();
  std::vector<double> acceleration(count, limits_.acceleration);
  for (std::size_t i = 0; i < count; ++i) {
    double steepest = 0;  // change of curvature along the path [1/m^2]
    for (const std::size_t j : {i, i + 1}) {
      if (j == 0 || j >= count) continue;
      const double travel = std::max(knots[j].travel - knots[j - 1].travel, 1e-9);
      steepest = std::max(steepest, std::abs(knots[j].curvature - knots[j - 1].curvature) / travel);
    }
    const double curvature = std::abs(knots[i].curvature);
    // Turn acceleration = speed^2 * steepness + acceleration * curvature, of which each term may use half of the limit.
    double speed = limits_.speed;
    if (steepest > 0) speed = std::min(speed, std::sqrt(0.5 * limits_.turn_acceleration / steepest));
    if (curvature > 0) {
      speed = std::min({speed, limits_.turn / curvature, std::sqrt(limits_.acceleration / curvature)});
      acceleration[i] = std::min(acceleration[i], 0.5 * limits_.turn_acceleration / curvature);
    }
    knots[i].speed = i == 0 || i + 1 == count ? 0 : speed;
  }
  const auto bound = [&](Knot& knot, const Knot& neighbour, double available) {
    knot.speed = std::min(knot.speed, std::sqrt(neighbour.speed * neighbour.speed +
                                                2 * available * std::abs(knot.travel - neighbour.travel)));
  };
  for (std::size_t i = 1; i < count; ++i) bound(knots[i], knots[i - 1], std::min(acceleration[i], acceleration[i - 1]));
  for (std::size_t i = count - 1; i-- > 0;)
    bound(knots[i], knots[i + 1], std::min(acceleration[i], acceleration[i + 1]));
  knots.front().time = duration_;
  for (std::size_t i = 1; i < count; ++i) {
    const double travel = knots[i].travel - knots[i - 1].travel, speeds = knots[i].speed + knots[i - 1].speed;
    knots[i].time = knots[i - 1].time + (travel > 0 ? 2 * travel / speeds : 0);
  }
  end_ = {knots.back().position.x(), knots.back().position.y(), geometry::wrapToPi(knots.back().yaw)};
  const double begin = duration_;
  duration_ = knots.back().time;
  legs_.push_back({begin, std::move(knots), {}});
}

geometry::Se2 DrivenMotion::poseIn(const Leg& leg, double time) const {
  if (leg.knots.empty()) {
    const Turn& turn = leg.turn;
    // The turn speeds up, goes on and slows down; by symmetry its second half is the first one backwards.
    const double limit = limits_.turn_acceleration, elapsed = std::clamp(time - turn.begin, 0.0, turn.duration);
    const double early = std::min(elapsed, turn.duration - elapsed);
    const double ramp = std::min(0.5 * turn.duration, limits_.turn / limit);
    double turned = early < ramp ? 0.5 * limit * early * early : limit * ramp * (early - 0.5 * ramp);
    if (elapsed > 0.5 * turn.duration) turned = std::abs(turn.angle) - turned;
    if (turn.angle == 0) turned = 0;
    return {turn.position.x(), turn.position.y(), geometry::wrapToPi(turn.from + std::copysign(turned, turn.angle))};
  }
  const auto after = std::upper_bound(leg.knots.begin() + 1, leg.knots.end() - 1, time,
                                      [](double t, const Knot& knot) { return t < knot.time; });
  const Knot &from = *(after - 1), &to = *after;
  const double span = to.time - from.time, length = to.travel - from.travel;
  if (span <= 0) return {to.position.x(), to.position.y(), geometry::wrapToPi(to.yaw)};
  const double elapsed = std::clamp(time - from.time, 0.0, span);
  const double travel = from.speed * elapsed + 0.5 * (to.speed - from.speed) / span * elapsed * elapsed;
  // Cubic interpolation between the knots, with their directions and curvatures.
  const double s = travel / length, s2 = s * s, s3 = s2 * s;
  const double h0 = 2 * s3 - 3 * s2 + 1, h1 = s3 - 2 * s2 + s, h2 = 3 * s2 - 2 * s3, h3 = s3 - s2;
  const Eigen::Vector2d from_heading(std::cos(from.yaw), std::sin(from.yaw)),
      to_heading(std::cos(to.yaw), std::sin(to.yaw));
  const Eigen::Vector2d position =
      h0 * from.position + h1 * length * from_heading + h2 * to.position + h3 * length * to_heading;
  const double yaw = h0 * from.yaw + h1 * length * from.curvature + h2 * to.yaw + h3 * length * to.curvature;
  return {position.x(), position.y(), geometry::wrapToPi(yaw)};
}

std::vector<geometry::Se2> DrivenMotion::sampled(double step, double until) const {
  std::vector<geometry::Se2> poses;
  std::size_t leg = 0;
  if (legs_.empty()) return {end_};
  for (int i = 0; (i - 1) * step < std::min(duration_, until); ++i) {
    while (leg + 1 < legs_.size() && legs_[leg + 1].begin <= i * step) ++leg;
    poses.push_back(poseIn(legs_[leg], i * step));
  }
  return poses;
}

}  // namespace omnimapper::sim

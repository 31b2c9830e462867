#include "Sight.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::interaction {

namespace {

using Eigen::Vector3d;

// [m] by which something must be nearer than a point to hide it: the error of a mapped surface, or the depth of an
// object that stands on it.
constexpr double kNearer = 0.05;
constexpr int kDirections = 1000;

Vector3d meanOf(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

}  // namespace

Sight::Sight(const Vector3d& eye, const std::vector<PointedCandidate>& candidates)
    : eye_(eye), candidates_(candidates) {
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const PointedCandidate& candidate = candidates[i];
    const auto add = [&](const geometry::Polygon3& outline, std::vector<Surface>& surfaces) {
      const Vector3d normal = geometry::areaVector(outline);
      if (!(normal.norm() > 0)) return;
      const Vector3d centre = meanOf(outline.vertices);
      double radius = 0;
      for (const Vector3d& v : outline.vertices) radius = std::max(radius, (v - centre).norm());
      surfaces.push_back({i, &outline, normal.normalized(), centre, radius});
    };
    add(candidate.outline, surfaces_);
    add(candidate.reach, unseen_);
    if (candidate.points.empty()) continue;
    Object object;
    object.candidate = i;
    const Vector3d middle = meanOf(candidate.points) - eye;
    object.distance = middle.norm();
    if (!(object.distance > 0)) continue;
    object.ahead = middle / object.distance;
    object.right = object.ahead.unitOrthogonal();
    object.up = object.right.cross(object.ahead);
    std::vector<Eigen::Vector2d> seen;
    for (const Vector3d& point : candidate.points) {
      const Vector3d p = point - eye;
      const double depth = p.dot(object.ahead);
      if (depth > kNearer) seen.emplace_back(p.dot(object.right) / depth, p.dot(object.up) / depth);
    }
    object.hull = geometry::convexHull(std::move(seen));
    objects_.push_back(std::move(object));
  }
  lookAround();
}

// A spiral from pole to pole, in steps of the golden angle.
void Sight::lookAround() {
  constexpr double kGoldenAngle = 2.39996322972865332;
  hits_.assign(candidates_.size(), 0);
  for (int k = 0; k < kDirections && hasSurfaces(); ++k) {
    const double z = 1 - (2 * k + 1.0) / kDirections, level = std::sqrt(1 - z * z);
    const Vector3d direction(level * std::cos(k * kGoldenAngle), level * std::sin(k * kGoldenAngle), z);
    if (const auto surface = surfaceAt(direction)) ++hits_[*surface];
  }
}

std::optional<double> Sight::distanceTo(const Surface& surface, const Vector3d& direction) const {
  const double along = surface.normal.dot(direction);
  if (std::abs(along) < 1e-9) return std::nullopt;
  const double distance = surface.normal.dot(surface.centre - eye_) / along;
  if (!(distance > 0)) return std::nullopt;
  const Vector3d hit = eye_ + distance * direction;
  if ((hit - surface.centre).squaredNorm() > surface.radius * surface.radius) return std::nullopt;
  if (!geometry::contains(*surface.outline, hit)) return std::nullopt;
  return distance;
}

bool Sight::covers(const Object& object, const Vector3d& direction) {
  const double depth = direction.dot(object.ahead);
  if (!(depth > 0) || object.hull.size() < 3) return false;
  const Eigen::Vector2d p(direction.dot(object.right) / depth, direction.dot(object.up) / depth);
  for (std::size_t i = 0; i < object.hull.size(); ++i) {
    const Eigen::Vector2d &a = object.hull[i], b = object.hull[(i + 1) % object.hull.size()];
    if ((b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() < 0) return false;
  }
  return true;
}

std::optional<Sight::Met> Sight::firstOf(const std::vector<Surface>& surfaces, const Vector3d& direction) const {
  std::optional<Met> first;
  for (const Surface& surface : surfaces) {
    const auto distance = distanceTo(surface, direction);
    if (distance && (!first || *distance < first->distance)) first = Met{surface.candidate, *distance};
  }
  return first;
}

std::optional<std::size_t> Sight::surfaceAt(const Vector3d& direction) const {
  auto first = firstOf(surfaces_, direction);
  if (!first) first = firstOf(unseen_, direction);
  if (!first) return std::nullopt;
  for (const Object& object : objects_)
    if (object.distance < first->distance && covers(object, direction)) return std::nullopt;
  return first->candidate;
}

bool Sight::isHidden(const Vector3d& point, std::size_t own) const {
  const double range = (point - eye_).norm();
  if (!(range > 0)) return false;
  const Vector3d direction = (point - eye_) / range;
  for (const Surface& surface : surfaces_) {
    if (surface.candidate == own) continue;
    const auto distance = distanceTo(surface, direction);
    if (distance && *distance < range - kNearer) return true;
  }
  for (const Object& object : objects_)
    if (object.candidate != own && object.distance < range - kNearer && covers(object, direction)) return true;
  return false;
}

// Van Oosterom and Strackee: The solid angle of a plane triangle, IEEE Trans. Biomedical Engineering 30 (1983). The
// signed angles of the triangles of a fan add up to that of the polygon, also where it is concave.
double Sight::solidAngle(std::size_t surface) const {
  const auto& candidate = candidates_[surface];
  const auto& vertices = (candidate.reach.vertices.empty() ? candidate.outline : candidate.reach).vertices;
  double sum = 0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const Vector3d a = vertices[0] - eye_, b = vertices[i] - eye_, c = vertices[i + 1] - eye_;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
  }
  return std::abs(sum);
}

// A few hits say little of a solid angle. A surface of which less is seen is small, or hidden but for a margin.
double Sight::seenAngle(std::size_t surface) const {
  constexpr int kEnough = 20;
  constexpr double kThinnest = 1e-3;
  const double whole = std::max(solidAngle(surface), kThinnest);
  return hits_[surface] < kEnough ? whole : std::min(whole, hits_[surface] * 4 * M_PI / kDirections);
}

bool Sight::isSeen(std::size_t candidate) const {
  if (hits_[candidate] > 0) return true;
  const PointedCandidate& it = candidates_[candidate];
  if (!it.points.empty()) {
    const auto isHiddenPoint = [&](const Vector3d& point) { return isHidden(point, candidate); };
    return !std::all_of(it.points.begin(), it.points.end(), isHiddenPoint);
  }
  return it.outline.vertices.size() >= 3 && !isHidden(meanOf(it.outline.vertices), candidate);
}

double Sight::rangeOf(std::size_t candidate) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : candidates_[candidate].points) nearest = std::min(nearest, (point - eye_).norm());
  const auto& vertices = candidates_[candidate].outline.vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector3d &a = vertices[i], b = vertices[(i + 1) % vertices.size()];
    const double length = (b - a).squaredNorm();
    const double share = length > 0 ? std::clamp((eye_ - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (a + share * (b - a) - eye_).norm());
  }
  if (vertices.size() >= 3 && geometry::contains(candidates_[candidate].outline, eye_)) {
    const Vector3d normal = geometry::areaVector(candidates_[candidate].outline).normalized();
    nearest = std::min(nearest, std::abs(normal.dot(eye_ - vertices[0])));
  }
  return nearest;
}

}  // namespace omnimapper::interaction

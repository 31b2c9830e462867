#include "LabelCandidates.h"

#include <omnimapper/derived/LandmarkShapes.h>

#include <algorithm>

namespace omnimapper::plugins {

namespace {

using Eigen::Vector3d;
using interaction::PointedCandidate;

constexpr std::size_t kMostPoints = 100;

// A grid of points on the faces of the box.
std::vector<Vector3d> pointsOf(const map::Box& box) {
  std::vector<Vector3d> points;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k)
        if (std::max({std::abs(i), std::abs(j), std::abs(k)}) == 2)
          points.push_back(box.middle + box.map_from_box * box.size.cwiseProduct(Vector3d(i, j, k) / 4));
  return points;
}

std::vector<Vector3d> thinned(const std::vector<Vector3d>& points) {
  const std::size_t step = (points.size() + kMostPoints - 1) / kMostPoints;
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i]);
  return kept;
}

// A wall goes on up to the ceiling, also where the camera has not seen it. What is lower may be a piece of furniture.
geometry::Polygon3 reachOfWall(const geometry::Polygon3& outline) {
  constexpr double kWall = 1, kCeiling = 2.4, kUpright = 0.2;  // [m], [m], z of the unit normal
  const Vector3d normal = geometry::areaVector(outline).normalized();
  if (std::abs(normal.z()) > kUpright) return {};
  const Vector3d along = Vector3d(-normal.y(), normal.x(), 0).normalized();
  double low = outline.vertices[0].z(), high = low, from = 0, to = 0;
  const Vector3d origin = outline.vertices[0];
  for (const Vector3d& corner : outline.vertices) {
    low = std::min(low, corner.z());
    high = std::max(high, corner.z());
    from = std::min(from, (corner - origin).dot(along));
    to = std::max(to, (corner - origin).dot(along));
  }
  if (high - low < kWall) return {};
  const double top = std::max(high, low + kCeiling);
  const auto at = [&](double where, double z) {
    const Vector3d level = origin + where * along;
    return Vector3d(level.x(), level.y(), z);
  };
  return {{at(from, low), at(to, low), at(to, top), at(from, top)}};
}

PointedCandidate candidateOf(const map::LandmarkShape& shape) {
  PointedCandidate candidate;
  double largest = 0;
  for (const auto& surface : shape.surfaces) {
    const double area = geometry::area(surface);
    if (area <= largest) continue;
    largest = area;
    candidate.outline = surface;
  }
  if (largest > 0) {
    // Everything stands on the floor: where a thing is not mapped yet, or only a part of it, the ray meets the floor.
    constexpr double kSeldom = 0.1;
    if (shape.label == "floor" || shape.label == "ceiling") candidate.weight = kSeldom;
    if (shape.label == "wall") candidate.reach = reachOfWall(candidate.outline);
    return candidate;
  }
  if (shape.mesh)
    candidate.points = thinned(shape.mesh->vertices);
  else if (shape.box)
    candidate.points = pointsOf(*shape.box);
  else
    candidate.points = thinned(shape.points);
  return candidate;
}

}  // namespace

LabelCandidates labelCandidates(const mapper::State& state, obs::CommandSubject subject) {
  LabelCandidates found;
  for (const auto& shaped : derived::shapesOf(state)) {
    if (shaped.moved) continue;
    PointedCandidate candidate = candidateOf(shaped.shape);
    const bool is_surface = candidate.points.empty();
    if (is_surface && candidate.outline.vertices.empty()) continue;
    candidate.may_be_meant = subject == obs::CommandSubject::any || (subject == obs::CommandSubject::map) == is_surface;
    found.landmarks.push_back(shaped.landmark->id);
    found.candidates.push_back(std::move(candidate));
  }
  return found;
}

Vector3d middleOf(const PointedCandidate& candidate) {
  const auto& points = candidate.points.empty() ? candidate.outline.vertices : candidate.points;
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

}  // namespace omnimapper::plugins

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

PointedCandidate candidateOf(const map::LandmarkShape& shape) {
  PointedCandidate candidate;
  double largest = 0;
  for (const auto& surface : shape.surfaces) {
    const double area = geometry::area(surface);
    if (area <= largest) continue;
    largest = area;
    candidate.outline = surface;
  }
  if (largest > 0) return candidate;
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

#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::derived {

namespace {

constexpr double kLeastOfPlan = 1e-3;  // [m]

// The line that an upright surface stands on: as long as the surface, at the mean of its vertices if it is tilted.
PlanLine baseLine(const geometry::Polygon3& surface, const Eigen::Vector3d& area_vector) {
  const PlanPoint across = area_vector.head<2>().normalized(), along(-across.y(), across.x());
  double low = std::numeric_limits<double>::infinity(), high = -low, offset = 0;
  for (const auto& vertex : surface.vertices) {
    const double at = along.dot(vertex.head<2>());
    low = std::min(low, at);
    high = std::max(high, at);
    offset += across.dot(vertex.head<2>()) / static_cast<double>(surface.vertices.size());
  }
  return {low * along + offset * across, high * along + offset * across};
}

void addLine(PlanShape& plan, const PlanLine& line) {
  if ((line.second - line.first).norm() < kLeastOfPlan) {
    plan.points.push_back(line.first);
  } else {
    plan.lines.push_back(line);
  }
}

void addSurface(PlanShape& plan, const geometry::Polygon3& surface) {
  constexpr double kUpright = 0.34;  // largest z of the normal of an upright surface: 20 deg of tilt
  const Eigen::Vector3d area_vector = geometry::areaVector(surface);
  if (std::abs(area_vector.z()) < kUpright * area_vector.norm()) {
    addLine(plan, baseLine(surface, area_vector));
    return;
  }
  PlanArea area;
  for (const auto& vertex : surface.vertices) {
    const PlanPoint corner = vertex.head<2>();
    if (area.empty() || (corner - area.back()).norm() >= kLeastOfPlan) area.push_back(corner);
  }
  if (area.size() > 1 && (area.front() - area.back()).norm() < kLeastOfPlan) area.pop_back();
  if (area.size() < 3 || std::abs(doubledArea(area)) < kLeastOfPlan * kLeastOfPlan) return;
  if (doubledArea(area) < 0) std::reverse(area.begin(), area.end());
  plan.areas.push_back(std::move(area));
}

// The convex outline of corners from above.
void addHull(PlanShape& plan, const std::vector<Eigen::Vector3d>& corners) {
  std::vector<PlanPoint> points;
  for (const auto& corner : corners) points.emplace_back(corner.head<2>());
  const auto hull = geometry::convexHull(points);
  if (hull.size() > 2 && doubledArea(hull) >= kLeastOfPlan * kLeastOfPlan) plan.areas.push_back(hull);
}

}  // namespace

PlanShape fromAbove(const map::LandmarkShape& shape) {
  PlanShape plan;
  for (const auto& surface : shape.surfaces) addSurface(plan, surface);
  for (const auto& [from, to] : shape.lines) addLine(plan, {from.head<2>(), to.head<2>()});
  for (const auto& point : shape.points) plan.points.emplace_back(point.head<2>());
  if (shape.box) {
    const auto corners = shape.box->corners();
    addHull(plan, {corners.begin(), corners.end()});
  } else if (shape.mesh) {
    addHull(plan, shape.mesh->vertices);
  }
  return plan;
}

double doubledArea(const PlanArea& walk) {
  double sum = 0;
  for (std::size_t i = 0, j = walk.size() - 1; i < walk.size(); j = i++) {
    const PlanPoint a = walk[j] - walk[0],
                    b = walk[i] - walk[0];  // relative to the first corner, which loses less precision
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

std::vector<std::pair<double, double>> dashesOf(double length, double dash) {
  constexpr double kMost = 10000;
  const auto gaps = static_cast<int>(std::clamp(0.5 * (length / dash - 1), 0.0, kMost));
  const double step = 1.0 / (2 * gaps + 1);
  std::vector<std::pair<double, double>> dashes;
  for (int i = 0; i <= gaps; ++i) dashes.emplace_back(2 * i * step, (2 * i + 1) * step);
  return dashes;
}

}  // namespace omnimapper::derived

#include <omnimapper/testing/FloorPlan.h>

#include <cmath>
#include <limits>

namespace omnimapper::testing {

namespace {
// A square pillar about a centre.
std::vector<Eigen::Vector2d> pillar(double x, double y, double side) {
  const double h = side / 2;
  return {{x - h, y - h}, {x + h, y - h}, {x + h, y + h}, {x - h, y + h}};
}
}  // namespace

void FloorPlan::addPolygon(const std::vector<Eigen::Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
}

double FloorPlan::distanceToWall(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction) const {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& wall : walls) {
    const Eigen::Vector2d along = wall.to - wall.from, to_wall = wall.from - origin;
    const double parallel = cross(direction, along);
    if (std::abs(parallel) < 1e-12) continue;
    const double distance = cross(to_wall, along) / parallel, part = cross(to_wall, direction) / parallel;
    if (distance > 0 && part >= 0 && part <= 1) nearest = std::min(nearest, distance);
  }
  return nearest;
}

FloorPlan FloorPlan::ring() {
  FloorPlan plan;
  // The outer walls, counter-clockwise from the lower left corner, with doors into rooms and niches of different
  // shapes.
  plan.addPolygon({{-10, -1.5},  {-7, -1.5},  {-7, -4},    {-4.5, -4},  {-4.5, -1.5}, {-1, -1.5},   {-1, -2.1},
                   {0.4, -2.1},  {0.4, -1.5}, {4, -1.5},   {4, -3.5},   {5, -4.5},    {6.5, -4.5},  {6.5, -1.5},
                   {10, -1.5},   {10, 1.2},   {11.2, 1.2}, {11.2, 3},   {10, 3},      {10, 6.2},    {12.5, 6.2},
                   {12.5, 8},    {10, 8},     {10, 10.5},  {7.5, 10.5}, {7.5, 11.3},  {5, 12},      {3.8, 12},
                   {3.8, 10.5},  {0.5, 10.5}, {0.5, 13},   {-2.5, 13},  {-2.5, 10.5}, {-5.8, 10.5}, {-6.6, 11.4},
                   {-7.4, 10.5}, {-10, 10.5}, {-10, 7},    {-10.8, 7},  {-10.8, 5.6}, {-10, 5.6},   {-10, 3.3},
                   {-12, 2.4},   {-12, 1},    {-10, 1}});
  // The walls of the block in the middle.
  plan.addPolygon({{-7, 1.5},   {-5, 1.5}, {-5, 2.6},  {-3.2, 2.6}, {-3.2, 1.5}, {1.2, 1.5},  {2, 2.3},
                   {2.8, 1.5},  {7, 1.5},  {7, 4},     {5.8, 4},    {5.8, 5.1},  {7, 5.1},    {7, 7.5},
                   {3, 7.5},    {3, 6.4},  {0.6, 6.4}, {0.6, 7.5},  {-4.4, 7.5}, {-4.4, 6.9}, {-5.4, 6.9},
                   {-5.4, 7.5}, {-7, 7.5}, {-7, 5.6},  {-6.2, 4.9}, {-7, 4.2}});
  plan.addPolygon(pillar(-2, -1.1, 0.4));
  plan.addPolygon(pillar(2.9, 1.1, 0.3));
  plan.addPolygon(pillar(9.5, 4.6, 0.5));
  plan.addPolygon(pillar(-8.2, 9.9, 0.4));
  plan.addPolygon(pillar(-9.4, 0.1, 0.35));
  return plan;
}

FloorPlan FloorPlan::box() {
  FloorPlan plan;
  plan.addPolygon({{-4, -1.5}, {4, -1.5}, {4, 4.5}, {-4, 4.5}});
  plan.addPolygon(pillar(0.6, 1.7, 0.5));
  return plan;
}

}  // namespace omnimapper::testing

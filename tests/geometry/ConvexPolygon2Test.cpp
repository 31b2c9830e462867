#include <gtest/gtest.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace omnimapper::geometry::convex_polygon2_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

TEST(ConvexPolygon2, HullOfASquareWithPointsInsideAndOnEdgesIsTheSquare) {
  const Points hull = convexHull({{1, 1}, {0, 0}, {0.5, 0.5}, {1, 0}, {0.5, 0}, {0, 1}, {0, 0}});
  EXPECT_EQ(hull, (Points{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_DOUBLE_EQ(area(hull), 1);
}

TEST(ConvexPolygon2, HullOfALineIsItsEnds) {
  EXPECT_EQ(convexHull({{1, 1}, {3, 3}, {2, 2}}), (Points{{1, 1}, {3, 3}}));
  EXPECT_EQ(convexHull({{1, 1}, {1, 1}}), (Points{{1, 1}}));
  EXPECT_TRUE(convexHull({}).empty());
}

TEST(ConvexPolygon2, ACrossHasNoCornerOfOneInTheOther) {
  const Points across = rectangle(-2, -0.5, 4, 1), along = rectangle(-0.5, -2, 1, 4);
  EXPECT_DOUBLE_EQ(distance(across, along), 0);
}

TEST(ConvexPolygon2, DistanceOfPolygonsSegmentsAndPoints) {
  EXPECT_DOUBLE_EQ(distance(rectangle(0, 0, 1, 1), rectangle(1.5, 2, 1, 1)), std::hypot(0.5, 1));
  EXPECT_DOUBLE_EQ(distance({{0, 0}, {2, 0}}, {{1, -1}, {1, 1}}), 0);
  EXPECT_DOUBLE_EQ(distance({{0, 0}, {2, 0}}, {{3, 1}}), std::hypot(1, 1));
  EXPECT_DOUBLE_EQ(distance(rectangle(0, 0, 4, 4), {{1, 1}, {2, 2}}), 0);
}

// Whether the whole other polygon is beyond one edge of this one.
bool hasEdgeBetween(const Points& polygon, const Points& other) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d from = polygon[i], edge = polygon[(i + 1) % polygon.size()] - from;
    const auto isBeyond = [&](const Eigen::Vector2d& p) {
      return edge.x() * (p - from).y() - edge.y() * (p - from).x() < 0;
    };
    if (std::all_of(other.begin(), other.end(), isBeyond)) return true;
  }
  return false;
}

TEST(ConvexPolygon2, NoPairOfRandomPointsIsNearerThanTheHulls) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 100; ++round) {
    Points a, b;
    for (int i = 0; i < 8; ++i) a.emplace_back(normal(random), normal(random));
    for (int i = 0; i < 8; ++i) b.emplace_back(3 + normal(random), normal(random));
    const Points hull_a = convexHull(a), hull_b = convexHull(b);
    const double gap = distance(hull_a, hull_b);
    for (const auto& p : a)
      for (const auto& q : b) EXPECT_GE((p - q).norm(), gap);
    EXPECT_EQ(gap > 0, hasEdgeBetween(hull_a, hull_b) || hasEdgeBetween(hull_b, hull_a));
  }
}

}  // namespace
}  // namespace omnimapper::geometry::convex_polygon2_test

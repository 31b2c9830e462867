#include <gtest/gtest.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>

#include "ConvexHull.h"

namespace omnimapper::perception::convex_hull_test {
namespace {

using Eigen::Vector2d;

TEST(ConvexHull, GoesRoundTheOuterPointsCounterClockwise) {
  const auto hull = convexHull({{1, 1}, {0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}, {2, 0}});
  EXPECT_EQ(hull, (std::vector<Vector2d>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
}

TEST(ConvexHull, OfLittleIsLittle) {
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_EQ(convexHull({{1, 2}}).size(), 1U);
  EXPECT_EQ(convexHull({{1, 2}, {1, 2}}).size(), 1U);
  EXPECT_EQ(convexHull({{0, 0}, {1, 1}, {2, 2}}), (std::vector<Vector2d>{{0, 0}, {2, 2}}));
}

TEST(ConvexHull, IsNearByTheMargin) {
  const std::vector<Vector2d> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const HullNeighbourhood near(square);
  EXPECT_TRUE(near.holds({1, 1}, 0));
  EXPECT_FALSE(near.holds({2.05, 1}, 0));
  EXPECT_TRUE(near.holds({2.05, 1}, 0.1));
  EXPECT_FALSE(HullNeighbourhood(std::vector<Vector2d>{{0, 0}, {1, 1}}).holds({0, 0}, 1)) << "no area";
}

// The corners are on a circle; between them are the middles of edges and many points inside.
TEST(ConvexHull, OfManyPointsHasTheCornersAndNothingElse) {
  testing::Dice dice(7);
  const int corners = 40;
  std::vector<Vector2d> expected, points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners - M_PI;  // the smallest x first
    expected.emplace_back(3 * std::cos(angle), 3 * std::sin(angle));
  }
  for (int i = 0; i < 5000; ++i) {
    const auto &a = expected[static_cast<std::size_t>(i % corners)], &b = expected[static_cast<std::size_t>(i % 7)];
    points.push_back(0.99 * (a + dice.uniform(0, 1) * (b - a)));
  }
  points.insert(points.begin() + 1000, expected.begin(), expected.end());
  EXPECT_EQ(convexHull(points), expected);
}

TEST(ConvexHull, OfManyPointsOnALineIsItsEnds) {
  std::vector<Vector2d> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(i % 500, 2.0 * (i % 500));
  EXPECT_EQ(convexHull(points), (std::vector<Vector2d>{{0, 0}, {499, 998}}));
  EXPECT_EQ(convexHull(std::vector<Vector2d>(1000, {1, 2})), std::vector<Vector2d>{Vector2d(1, 2)});
}

}  // namespace
}  // namespace omnimapper::perception::convex_hull_test

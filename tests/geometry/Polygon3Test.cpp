#include <gtest/gtest.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/geometry/Se3.h>

#include <algorithm>
#include <limits>
#include <random>

namespace omnimapper::geometry::polygon3_test {
namespace {

// An L of area 3: a square of 2 x 2 without its upper right quarter, counter-clockwise seen from above.
Polygon3 bracket() {
  return {{{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}}};
}

Polygon3 moved(const Se3& a_from_b, const Polygon3& polygon) {
  Polygon3 result;
  for (const auto& vertex : polygon.vertices) result.vertices.push_back(a_from_b * vertex);
  return result;
}

TEST(Polygon3, AreaOfAConcavePolygonAsWorkedByHand) {
  EXPECT_NEAR(area(bracket()), 3, 1e-15);
  EXPECT_LT((areaVector(bracket()) - Eigen::Vector3d(0, 0, 3)).norm(), 1e-15);
  Polygon3 reversed = bracket();
  std::reverse(reversed.vertices.begin(), reversed.vertices.end());
  EXPECT_LT((areaVector(reversed) + Eigen::Vector3d(0, 0, 3)).norm(), 1e-15);
}

TEST(Polygon3, FewerThanThreeVerticesHaveNoAreaAndContainNothing) {
  for (const Polygon3& polygon : {Polygon3{}, Polygon3{{{1, 2, 3}}}, Polygon3{{{1, 2, 3}, {4, 5, 6}}}}) {
    EXPECT_EQ(area(polygon), 0);
    EXPECT_FALSE(contains(polygon, {1, 2, 3}));
  }
  EXPECT_FALSE(contains({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, {1, 0, 0}));
}

TEST(Polygon3, ContainsTheFeetOfPointsInItsInnerAndNotThoseInItsNotch) {
  EXPECT_TRUE(contains(bracket(), {0.5, 1.5, 1}));
  EXPECT_TRUE(contains(bracket(), {1.5, 0.5, 7}));
  EXPECT_FALSE(contains(bracket(), {1.5, 1.5, 1}));
  EXPECT_FALSE(contains(bracket(), {-0.1, 0.5, 1}));
  EXPECT_FALSE(contains(bracket(), {0.5, 2.1, 1}));
}

TEST(Polygon3, NothingChangesWhenTheWholeMoves) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> even(-3, 3);
  for (int i = 0; i < 50; ++i) {
    Vector6d step;
    for (auto& value : step) value = even(engine);
    const Se3 a_from_b = plus(Se3{}, step);
    const Polygon3 polygon = moved(a_from_b, bracket());
    EXPECT_NEAR(area(polygon), 3, 1e-12);
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d point(even(engine), even(engine), even(engine));
      EXPECT_EQ(contains(polygon, a_from_b * point), contains(bracket(), point));
    }
  }
}

TEST(Polygon3, NotANumberIsContainedNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(contains(bracket(), {nan, nan, nan}));
  Polygon3 damaged = bracket();
  damaged.vertices[2].x() = nan;
  EXPECT_FALSE(contains(damaged, {0.5, 0.5, 1}));
}

}  // namespace
}  // namespace omnimapper::geometry::polygon3_test

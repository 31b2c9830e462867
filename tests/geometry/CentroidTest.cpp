#include <gtest/gtest.h>
#include <omnimapper/geometry/centroid.h>
#include <omnimapper/geometry/motionBetween.h>

namespace omnimapper::geometry::centroid_test {
namespace {

using Eigen::Vector2d;

TEST(Centroid, isThatOfTheAreaAndALineHasNone) {
  // An L of a square of 2 m and one of 1 m beside it: (4 (1, 1) + 1 (2.5, 0.5)) / 5.
  EXPECT_LT((*centroid({{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 2}, {0, 2}}) - Vector2d(1.3, 0.9)).norm(), 1e-12);
  EXPECT_FALSE(centroid({{0, 0}, {1, 1}, {2, 2}}));
  EXPECT_FALSE(centroid({}));
}

TEST(MotionBetween, findsTheMotionOfPairsAndDoesNotTurnASinglePoint) {
  const Se2 motion{3, -2, 2.5};
  std::vector<std::pair<Vector2d, Vector2d>> pairs;
  for (const Vector2d& point : {Vector2d(1, 0), Vector2d(4, 2), Vector2d(-1, 5)})
    pairs.emplace_back(point, motion * point);
  EXPECT_LT(minus(motionBetween(pairs), motion).norm(), 1e-12);
  EXPECT_LT(minus(motionBetween({{{1, 2}, {4, 6}}}), {3, 4, 0}).norm(), 1e-12);
}

}  // namespace
}  // namespace omnimapper::geometry::centroid_test

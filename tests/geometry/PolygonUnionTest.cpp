#include <gtest/gtest.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/PolygonUnion.h>

#include <cmath>
#include <set>

namespace omnimapper::geometry::polygon_union_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(PolygonUnion, OfTwoThatCrossIsConcave) {
  const auto cross = unionOf({rectangle(-3, -1, 3, 1), rectangle(-1, -3, 1, 3)});
  ASSERT_EQ(cross.size(), 1U);
  EXPECT_EQ(cross[0].size(), 12U);
  EXPECT_NEAR(area(cross[0]), 12 + 12 - 4, 1e-12);
}

TEST(PolygonUnion, KeepsApartWhatDoesNotTouch) {
  const auto two = unionOf({rectangle(0, 0, 1, 1), rectangle(2, 0, 3, 1)});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NEAR(area(two[0]) + area(two[1]), 2, 1e-12);
}

TEST(PolygonUnion, GoesCounterClockwiseWhicheverWayTheyWent) {
  const auto one = unionOf({{{0, 0}, {0, 1}, {1, 1}, {1, 0}}});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(area(one[0]), 1, 1e-12);
}

TEST(PolygonUnion, ClosesHoles) {
  const std::vector<Points> bars = {rectangle(0, 0, 3, 1), rectangle(0, 2, 3, 3), rectangle(0, 0, 1, 3),
                                    rectangle(2, 0, 3, 3)};
  std::vector<Points> island_first = {rectangle(1.2, 1.2, 1.8, 1.8)}, island_last = bars;
  island_first.insert(island_first.end(), bars.begin(), bars.end());
  island_last.push_back(island_first.front());
  for (const auto& all : {bars, island_first, island_last}) {
    const auto ring = unionOf(all);
    ASSERT_EQ(ring.size(), 1U);
    EXPECT_NEAR(area(ring[0]), 9, 1e-12);
  }
}

TEST(PolygonUnion, LeavesOutWhatHasNoArea) {
  EXPECT_TRUE(unionOf({}).empty());
  EXPECT_TRUE(unionOf({{}, {{1, 1}}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 0}, {2, 0}}}).empty());
}

TEST(PolygonUnion, TakesOfOneThatCrossesItselfAllItGoesAround) {
  const Points bow = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};  // its two halves go around different ways
  const auto halves = unionOf({bow});
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_NEAR(area(halves[0]), 0.25, 1e-12);
  EXPECT_NEAR(area(halves[1]), 0.25, 1e-12);
  const auto both = unionOf({bow, rectangle(0, 0, 1, 0.5)});
  ASSERT_EQ(both.size(), 1U);
  EXPECT_NEAR(area(both[0]), 0.75, 1e-12);
}

TEST(PolygonUnion, TakesCornersForOneThatAreAMicrometreApart) {
  const auto one = unionOf({rectangle(0, 0, 1, 1), rectangle(1 + 4e-7, 0, 2, 1)});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(area(one[0]), 2, 1e-5);
}

TEST(PolygonUnion, IsExactFarFromTheOrigin) {
  for (const double far : {2000., -9e5}) {
    const auto one = unionOf({rectangle(far, far, far + 2, far + 1), rectangle(far + 1, far, far + 3, far + 1)});
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].size(), 4U);
    EXPECT_NEAR(areaOutside(rectangle(far, far, far + 4, far + 1), one), 1, 1e-12);
  }
}

TEST(PolygonUnion, LeavesOutWhatIsNowhere) {
  for (const double wrong : {std::nan(""), HUGE_VAL, 1e14}) {
    const auto one = unionOf({rectangle(0, 0, 1, 1), rectangle(0, 0, wrong, 1)});
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NEAR(area(one[0]), 1, 1e-12);
    EXPECT_NEAR(areaOutside(rectangle(0, 0, 2, 1), {rectangle(0, 0, 1, 1), rectangle(0, 0, 1, wrong)}), 1, 1e-12);
    EXPECT_EQ(areaOutside(rectangle(0, 0, wrong, 1), {}), 0);
    EXPECT_TRUE(unionOf({{{0, 0}, {2, 0}, {2, 2}, {1, wrong}, {0, 2}}}).empty()) << "one corner is enough";
  }
}

TEST(PolygonUnion, IsTheSameInAnyOrder) {
  const std::vector<Points> some = {rectangle(0, 0, 2, 1), rectangle(1, 0.5, 3, 2), rectangle(2.5, 0, 2.9, 3),
                                    rectangle(10, 0, 11, 1)};
  std::vector<Points> others(some.rbegin(), some.rend());
  const auto first = unionOf(some), second = unionOf(others);
  double all = 0;
  for (const auto& outline : first) all += area(outline);
  EXPECT_NEAR(all, 2 + (3 - 0.5) + (0.4 * 3 - 0.4 * 1.5) + 1, 1e-12);
  const auto cornersOf = [](const std::vector<Points>& outlines) {
    std::set<std::pair<double, double>> corners;
    for (const auto& outline : outlines)
      for (const auto& corner : outline) corners.emplace(corner.x(), corner.y());
    return corners;
  };
  EXPECT_EQ(first.size(), second.size());
  EXPECT_EQ(cornersOf(first), cornersOf(second));
}

TEST(PolygonUnion, LeavesOutNeedlessCorners) {
  Points rough;
  for (int i = 0; i < 100; ++i) rough.emplace_back(0.02 * i, i % 2 == 0 ? 0 : 0.002);
  rough.emplace_back(2, 1);
  rough.emplace_back(0, 1);
  const auto smooth = unionOf({rough});
  ASSERT_EQ(smooth.size(), 1U);
  EXPECT_LE(smooth[0].size(), 6U);
}

TEST(AreaOutside, IsWhatOthersDoNotCover) {
  const auto seen = unionOf({rectangle(0, 0, 2, 1), rectangle(3, 0, 4, 1)});
  EXPECT_NEAR(areaOutside(rectangle(1, 0, 5, 1), seen), 1 + 1, 1e-12);
  EXPECT_NEAR(areaOutside(rectangle(0.5, 0.2, 1, 0.8), seen), 0, 1e-12);
  EXPECT_NEAR(areaOutside(rectangle(0, 0, 1, 1), {}), 1, 1e-12);
}

}  // namespace
}  // namespace omnimapper::geometry::polygon_union_test

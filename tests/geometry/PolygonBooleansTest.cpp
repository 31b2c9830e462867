#include <gtest/gtest.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/PolygonBooleans.h>

#include <cmath>
#include <set>

namespace omnimapper::geometry::polygon_booleans_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// Only the outlines of the union.
std::vector<Points> unionOf(const std::vector<Points>& polygons) {
  std::vector<HoledPolygon2> all;
  for (const auto& polygon : polygons) all.push_back({polygon, {}});
  return geometry::unionOf(all).outlines;
}

TEST(PolygonBooleans, OfTwoThatCrossIsConcave) {
  const auto cross = unionOf({rectangle(-3, -1, 3, 1), rectangle(-1, -3, 1, 3)});
  ASSERT_EQ(cross.size(), 1U);
  EXPECT_EQ(cross[0].size(), 12U);
  EXPECT_NEAR(area(cross[0]), 12 + 12 - 4, 1e-12);
}

TEST(PolygonBooleans, KeepsApartWhatDoesNotTouch) {
  const auto two = unionOf({rectangle(0, 0, 1, 1), rectangle(2, 0, 3, 1)});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NEAR(area(two[0]) + area(two[1]), 2, 1e-12);
}

TEST(PolygonBooleans, GoesCounterClockwiseWhicheverWayTheyWent) {
  const auto one = unionOf({{{0, 0}, {0, 1}, {1, 1}, {1, 0}}});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(area(one[0]), 1, 1e-12);
}

TEST(PolygonBooleans, KeepsHolesAndWhatLiesInThem) {
  std::vector<HoledPolygon2> ring{{rectangle(0, 0, 3, 3), {rectangle(1, 1, 2, 2)}}};
  auto areas = geometry::unionOf(ring);
  ASSERT_EQ(areas.outlines.size(), 1U);
  ASSERT_EQ(areas.holes.size(), 1U);
  EXPECT_NEAR(area(areas.outlines[0]), 9, 1e-12);
  EXPECT_NEAR(area(areas.holes[0]), -1, 1e-12);
  ring.push_back({rectangle(1.2, 1.2, 1.8, 1.8), {}});
  areas = geometry::unionOf(ring);
  EXPECT_EQ(areas.outlines.size(), 2U);
  EXPECT_EQ(areas.holes.size(), 1U);
}

TEST(PolygonBooleans, AHoleIsNoneWhereAnotherCoversIt) {
  const auto areas =
      geometry::unionOf({{rectangle(0, 0, 3, 3), {rectangle(1, 1, 2, 2)}}, {rectangle(1, 0, 1.5, 3), {}}});
  ASSERT_EQ(areas.holes.size(), 1U);
  EXPECT_NEAR(area(areas.holes[0]), -0.5, 1e-12);
}

TEST(PolygonBooleans, SmallHolesAndIslandsAreLeftOutAndTheLargestOutlineNever) {
  const std::vector<HoledPolygon2> some{{rectangle(0, 0, 3, 3), {rectangle(1, 1, 1.1, 1.1)}},
                                        {rectangle(5, 0, 5.1, 0.1), {}}};
  EXPECT_EQ(geometry::unionOf(some).outlines.size(), 2U);
  EXPECT_EQ(geometry::unionOf(some, 0.02).outlines.size(), 1U);
  EXPECT_TRUE(geometry::unionOf(some, 0.02).holes.empty());
  EXPECT_EQ(geometry::unionOf({some[1]}, 0.02).outlines.size(), 1U);
}

TEST(PolygonBooleans, LeavesOutWhatHasNoArea) {
  EXPECT_TRUE(unionOf({}).empty());
  EXPECT_TRUE(unionOf({{}, {{1, 1}}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 0}, {2, 0}}}).empty());
}

TEST(PolygonBooleans, TakesOfOneThatCrossesItselfAllItGoesAround) {
  const Points bow = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};  // its two halves have opposite senses of rotation
  const auto halves = unionOf({bow});
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_NEAR(area(halves[0]), 0.25, 1e-12);
  EXPECT_NEAR(area(halves[1]), 0.25, 1e-12);
  const auto both = unionOf({bow, rectangle(0, 0, 1, 0.5)});
  ASSERT_EQ(both.size(), 1U);
  EXPECT_NEAR(area(both[0]), 0.75, 1e-12);
}

TEST(PolygonBooleans, TakesCornersForOneThatAreAMicrometreApart) {
  const auto one = unionOf({rectangle(0, 0, 1, 1), rectangle(1 + 4e-7, 0, 2, 1)});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(area(one[0]), 2, 1e-5);
}

TEST(PolygonBooleans, IsExactFarFromTheOrigin) {
  for (const double far : {2000., -9e5}) {
    const auto one = unionOf({rectangle(far, far, far + 2, far + 1), rectangle(far + 1, far, far + 3, far + 1)});
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].size(), 4U);
  }
}

TEST(PolygonBooleans, LeavesOutWhatIsNowhere) {
  for (const double wrong : {std::nan(""), HUGE_VAL, 1e14}) {
    const auto one = unionOf({rectangle(0, 0, 1, 1), rectangle(0, 0, wrong, 1)});
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NEAR(area(one[0]), 1, 1e-12);
    EXPECT_TRUE(unionOf({{{0, 0}, {2, 0}, {2, 2}, {1, wrong}, {0, 2}}}).empty()) << "one corner is enough";
  }
}

TEST(PolygonBooleans, IsTheSameInAnyOrder) {
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

TEST(PolygonBooleans, LeavesOutNeedlessCorners) {
  Points rough;
  for (int i = 0; i < 100; ++i) rough.emplace_back(0.02 * i, i % 2 == 0 ? 0 : 0.002);
  rough.emplace_back(2, 1);
  rough.emplace_back(0, 1);
  const auto smooth = unionOf({rough});
  ASSERT_EQ(smooth.size(), 1U);
  EXPECT_LE(smooth[0].size(), 6U);
}

TEST(PolygonBooleans, WhatLiesWithinKeepsItsHoles) {
  const HoledPolygon2 frame{rectangle(0, 0, 4, 4), {rectangle(1, 1, 3, 3)}};
  const auto left = intersectionOf(frame, rectangle(-1, -1, 2, 5));
  ASSERT_EQ(left.outlines.size(), 1U);
  EXPECT_NEAR(area(left.outlines[0]), 2 * 4 - 1 * 2, 1e-12) << "like a C";
  const auto all = intersectionOf(frame, rectangle(-1, -1, 5, 5));
  ASSERT_EQ(all.outlines.size(), 1U);
  ASSERT_EQ(all.holes.size(), 1U);
  EXPECT_NEAR(area(all.outlines[0]) + area(all.holes[0]), 16 - 4, 1e-12);
}

TEST(PolygonBooleans, NothingLiesWithinWhatIsApartOrEmpty) {
  EXPECT_TRUE(intersectionOf({rectangle(0, 0, 1, 1), {}}, rectangle(2, 2, 3, 3)).outlines.empty());
  EXPECT_TRUE(intersectionOf({rectangle(0, 0, 1, 1), {}}, {}).outlines.empty());
  EXPECT_TRUE(intersectionOf({}, rectangle(2, 2, 3, 3)).outlines.empty());
}

}  // namespace
}  // namespace omnimapper::geometry::polygon_booleans_test

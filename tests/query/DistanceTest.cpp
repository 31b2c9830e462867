#include <gtest/gtest.h>
#include <omnimapper/query/Distance.h>

#include "HandMadeMap.h"

namespace omnimapper::query::distance_test {
namespace {

map::Extent frame() {
  map::Extent extent;
  extent.outlines = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  extent.holes = {{{1, 1}, {3, 1}, {3, 3}, {1, 3}}};
  return extent;
}

double distanceTo(const map::Extent& extent, double x, double y) {
  const auto nearest = nearestPoint(extent, {x, y});
  return nearest ? (*nearest - Eigen::Vector2d(x, y)).norm() : -1;
}

TEST(Distance, IsToTheEdgeOutsideAndZeroInside) {
  EXPECT_DOUBLE_EQ(distanceTo(frame(), 6, 2), 2);
  EXPECT_DOUBLE_EQ(distanceTo(frame(), 7, 8), 5) << "3 and 4 from the corner";
  EXPECT_DOUBLE_EQ(distanceTo(frame(), 0.5, 2), 0);
  EXPECT_DOUBLE_EQ(distanceTo(frame(), 1.5, 2), 0.5) << "in the hole";
  map::Extent with_island = frame();
  with_island.outlines.push_back({{1.4, 1.4}, {2.6, 1.4}, {2.6, 2.6}, {1.4, 2.6}});
  EXPECT_DOUBLE_EQ(distanceTo(with_island, 2, 2), 0);
  EXPECT_DOUBLE_EQ(distanceTo(wallFrom(0, 0, 4, 0).extent, 2, 3), 3);
  EXPECT_DOUBLE_EQ(distanceTo(wallFrom(0, 0, 4, 0).extent, 7, 4), 5) << "beyond its end";
  EXPECT_DOUBLE_EQ(distanceTo(wallFrom(1, 1, 1, 1).extent, 4, 5), 5) << "a wall without length";
  EXPECT_DOUBLE_EQ(distanceTo({}, 0, 0), -1);
}

TEST(Distance, TheNearestComesFirstWithinReach) {
  const auto places = placesOf({signAt(5, 0, "a"), wallFrom(0, 3, 9, 3), signAt(1, 0, "b"), map::Place()});
  const auto near = nearestPlaces(places.places, {0, 0}, 4, 10);
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].place->caption, "b");
  EXPECT_DOUBLE_EQ(near[0].distance, 1);
  EXPECT_DOUBLE_EQ(near[1].distance, 3);
  EXPECT_EQ(nearestPlaces(places.places, {0, 0}, 100, 2).size(), 2U);
}

TEST(Distance, TheRimIsAsDenseAsAskedButNotEndless) {
  const auto rim = rimOf(wallFrom(0, 0, 1, 0).extent, 0.25);
  ASSERT_EQ(rim.size(), 5U);
  EXPECT_DOUBLE_EQ(rim[1].x(), 0.25);
  EXPECT_LT(rimOf(wallFrom(0, 0, 1e6, 0).extent, 0.25).size(), 1100U);
}

}  // namespace
}  // namespace omnimapper::query::distance_test

#include <gtest/gtest.h>
#include <omnimapper/building/StraightWalls.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <Eigen/Geometry>
#include <cmath>

namespace omnimapper::building::straight_walls_test {

namespace {

using Eigen::Vector2d;
using Loop = std::vector<Vector2d>;

Storey storeyOf(Loop outline, double turn = 0) {
  Storey storey;
  Room& room = storey.rooms.emplace_back();
  room.id = 1;
  for (const auto& corner : outline) room.outline.push_back(Eigen::Rotation2Dd(turn) * corner);
  return storey;
}

Loop straight(const Storey& storey) {
  return straightOutlines(storey).front();
}

/// A room of 5 by 4 m with a wardrobe of 1.2 by 0.6 m at its lower wall.
Loop withWardrobe() {
  return {{0, 0}, {2, 0}, {2, 0.6}, {3.2, 0.6}, {3.2, 0}, {5, 0}, {5, 4}, {0, 4}};
}

}  // namespace

TEST(StraightWalls, FurnitureAtAWallLeavesNoDent) {
  const Loop outline = straight(storeyOf(withWardrobe()));
  EXPECT_EQ(outline.size(), 4U);
  EXPECT_NEAR(geometry::area(outline), 20, 1e-9);
}

TEST(StraightWalls, TheDirectionOfTheBuildingDoesNotMatter) {
  for (const double turn : {-0.7, -0.3, 0.2, 0.7, 2.0}) {
    const Storey storey = storeyOf(withWardrobe(), turn);
    EXPECT_NEAR(std::remainder(directionOfWalls(storey) - turn, M_PI / 2), 0, 1e-9);
    EXPECT_EQ(straight(storey).size(), 4U) << turn;
    EXPECT_NEAR(geometry::area(straight(storey)), 20, 1e-9);
  }
}

TEST(StraightWalls, FurnitureInACornerLeavesNoDent) {
  for (const Loop& outline : {Loop{{0.6, 0}, {5, 0}, {5, 4}, {0, 4}, {0, 1.8}, {0.6, 1.8}},
                              Loop{{0, 0}, {3.2, 0}, {3.2, 0.6}, {5, 0.6}, {5, 4}, {0, 4}}}) {
    EXPECT_EQ(straight(storeyOf(outline)).size(), 4U);
    EXPECT_NEAR(geometry::area(straight(storeyOf(outline))), 20, 1e-9);
  }
}

TEST(StraightWalls, ARoomWithACornerOfAnotherRoomStays) {
  const Loop outline{{0, 0}, {3, 0}, {3, 2}, {5, 2}, {5, 4}, {0, 4}};
  EXPECT_EQ(straight(storeyOf(outline)).size(), 6U);
  EXPECT_NEAR(geometry::area(straight(storeyOf(outline))), 16, 1e-9);
}

TEST(StraightWalls, ABayStays) {
  const Loop outline{{0, 0}, {2, 0}, {2, -0.6}, {3.2, -0.6}, {3.2, 0}, {5, 0}, {5, 4}, {0, 4}};
  EXPECT_NEAR(geometry::area(straight(storeyOf(outline))), 20.72, 1e-9);
}

TEST(StraightWalls, ADentWithADoorStays) {
  Storey storey = storeyOf(withWardrobe());
  Door& door = storey.doors.emplace_back();
  door.rooms = {1, 2};
  door.opening = {{2.2, 0.6}, {3.0, 0.6}};
  EXPECT_EQ(straight(storey).size(), 8U);
}

TEST(StraightWalls, SmallStepsAndSlantsOfTheRasterVanish) {
  const Loop outline{{0, 0}, {2, 0.05}, {2, 0.1}, {5, 0.1}, {5.05, 2}, {4.95, 2.05}, {5, 4}, {0, 4}};
  const Loop result = straight(storeyOf(outline));
  EXPECT_EQ(result.size(), 4U);
  EXPECT_NEAR(geometry::area(result), 19.7, 0.2);
}

TEST(StraightWalls, ARoundRoomKeepsItsOutline) {
  Loop outline;
  for (int i = 0; i < 24; ++i) outline.emplace_back(3 * std::cos(i * M_PI / 12), 3 * std::sin(i * M_PI / 12));
  EXPECT_EQ(straight(storeyOf(outline)), outline);
}

TEST(StraightWalls, OutlinesWithoutAreaDoNoHarm) {
  for (const Loop& outline : {Loop{}, Loop{{1, 1}}, Loop{{0, 0}, {1, 0}}, Loop{{0, 0}, {1, 0}, {2, 0}}})
    EXPECT_EQ(straight(storeyOf(outline)), outline);
}

}  // namespace omnimapper::building::straight_walls_test

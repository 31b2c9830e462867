#include <gtest/gtest.h>
#include <omnimapper/query/Route.h>

#include <cmath>

#include "TwoRooms.h"

namespace omnimapper::query::route_test {
namespace {

using Route = TwoRooms;

TEST_F(Route, IsAsLongAsStepsToEightNeighboursAllow) {
  const GridMap grid = readGrid(map_.folder);
  const RoomToMove room(grid, 0.25, {1.05, 1.05});
  const auto route = shortestRoute(room, grid, {2.05, 1.55}, &*map_.rooms);
  ASSERT_TRUE(route);
  // 10 cells to the right and 5 up: 5 steps across and 5 straight.
  EXPECT_NEAR(route->length, 0.1 * (5 * std::sqrt(2.0) + 5), 1e-6);
  EXPECT_EQ(route->points.size(), 11U);
  ASSERT_EQ(route->rooms.size(), 1U);
  EXPECT_EQ(route->rooms[0].room->id, 1);
  EXPECT_EQ(route->rooms[0].door, nullptr);
}

TEST_F(Route, KeepsTheRadiusOfTheRobotFromWalls) {
  const GridMap grid = readGrid(map_.folder);
  const RoomToMove room(grid, 0.25, {1, 1});
  const auto route = shortestRoute(room, grid, {7, 3}, nullptr);
  ASSERT_TRUE(route);
  EXPECT_TRUE(route->rooms.empty());
  for (const auto& point : route->points) EXPECT_TRUE(room.fits(grid.cellOf(point))) << point.transpose();
  EXPECT_FALSE(shortestRoute(RoomToMove(grid, 0.7, {1, 1}), grid, {7, 3}, nullptr)) << "the door is 1 m wide";
  EXPECT_FALSE(shortestRoute(RoomToMove(grid, 0.25, {50, 1}), grid, {7, 3}, nullptr)) << "no start";
}

TEST_F(Route, TheCentreOfARoomIsMovedToTheNearestFreePlace) {
  const GridMap grid = readGrid(map_.folder);
  const RoomToMove room(grid, 0.25, {1, 1});
  const auto centre = freeCentre(map_.rooms->rooms[1], room, grid);
  ASSERT_TRUE(centre);
  EXPECT_TRUE(room.isReached(grid.cellOf(*centre)));
  EXPECT_LT((*centre - map_.rooms->rooms[1].centre).norm(), 0.8);
  EXPECT_FALSE(freeCentre(map_.rooms->rooms[1], RoomToMove(grid, 2, {1, 1}), grid));
}

TEST_F(Route, ARoomThatIsSaidToBeEndlessIsSearchedInTheGridAlone) {
  const GridMap grid = readGrid(map_.folder);
  const RoomToMove room(grid, 0.25, {1, 1});
  building::Room endless = roomBetween(3, -1e6, -1e6, 1e6, 1e6);
  endless.centre = {30, 30};  // outside of the grid
  const auto centre = freeCentre(endless, room, grid);
  ASSERT_TRUE(centre);
  EXPECT_TRUE(room.isReached(grid.cellOf(*centre)));
  endless.centre = {1e6, -1e6};
  EXPECT_TRUE(freeCentre(endless, room, grid));
}

}  // namespace
}  // namespace omnimapper::query::route_test

#include <gtest/gtest.h>
#include <omnimapper/building/Segmentation.h>

#include <random>

#include "PaintedPlan.h"

namespace omnimapper::building::segmentation_test {
namespace {

using grid::GridCell;

std::vector<double> areasOf(const Segmentation& rooms) {
  std::vector<double> areas;
  for (const Room& room : rooms.storey.rooms) areas.push_back(room.area);
  std::sort(areas.begin(), areas.end());
  return areas;
}

int roomAt(const Segmentation& rooms, const grid::GridMap& grid, double x, double y) {
  return rooms.room_of_cell.at(grid.indexOf(grid.cellOf({x, y})));
}

TEST(Segmentation, aDoorSeparatesTwoRooms) {
  const PaintedPlan plan = twoRooms();
  const Segmentation rooms = segmentRooms(plan.grid());
  ASSERT_EQ(rooms.storey.rooms.size(), 2U);
  ASSERT_EQ(rooms.storey.doors.size(), 1U);
  const int left = roomAt(rooms, plan.grid(), 1, 1), right = roomAt(rooms, plan.grid(), 6, 1);
  EXPECT_NE(left, right);
  for (const Room& room : rooms.storey.rooms) {
    EXPECT_NEAR(room.area, room.id == left ? 12 : 9, 0.2);
    EXPECT_LT(room.openness, 0.05);
    EXPECT_FALSE(room.isOpen());
    EXPECT_EQ(room.neighbours, std::vector<int>{room.id == left ? right : left});
    EXPECT_NEAR(room.clearance, 1.5, 0.1);
  }
  const Door& door = rooms.storey.doors.front();
  EXPECT_LT((geometry::middle(door.opening) - Eigen::Vector2d(4.05, 1.45)).norm(), 0.15);
  EXPECT_NEAR(door.width, 0.9, 0.1);
  EXPECT_GT(door.confidence, 0.5);
  EXPECT_EQ(door.rooms, (std::array<int, 2>{1, 2}));
}

TEST(Segmentation, wallsMayHaveAnyDirection) {
  for (const double degrees : {7.0, 23.0, 45.0, 62.0, 118.0}) {
    const PaintedPlan plan = corridorWithRooms(0.05, degrees * M_PI / 180);
    const Segmentation rooms = segmentRooms(plan.grid());
    EXPECT_EQ(rooms.storey.rooms.size(), 4U) << degrees;
    EXPECT_EQ(rooms.storey.doors.size(), 3U) << degrees;
    const int corridor = roomAt(rooms, plan.grid(), 6, 1);
    for (const double x : {2.0, 6.0, 10.0}) EXPECT_NE(roomAt(rooms, plan.grid(), x, 4), corridor) << degrees;
    for (const double x : {0.3, 3.0, 11.7}) EXPECT_EQ(roomAt(rooms, plan.grid(), x, 1), corridor) << degrees;
  }
}

TEST(Segmentation, cellsOfAnyUsualSideGiveTheSameRooms) {
  const auto usual = areasOf(segmentRooms(corridorWithRooms(0.05).grid()));
  for (const double resolution : {0.02, 0.025, 0.1}) {
    const auto areas = areasOf(segmentRooms(corridorWithRooms(resolution).grid()));
    ASSERT_EQ(areas.size(), usual.size()) << resolution;
    for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], usual[i], 0.06 * usual[i]) << resolution;
  }
}

TEST(Segmentation, furnitureCutsNothing) {
  PaintedPlan plan = corridorWithRooms();
  for (const double x : {0.8, 1.6, 2.4})  // legs of tables and chairs
    for (const double y : {3.2, 3.9, 4.6}) plan.thing(x, y, x + 0.05, y + 0.05);
  plan.thing(4.05, 5.3, 6.5, 6.1);  // a cabinet at the wall
  plan.thing(9.6, 3.8, 10.6, 4.3);  // a desk in the middle
  plan.thing(3, 0, 3.4, 0.4);       // a bin in the corridor
  const Segmentation rooms = segmentRooms(plan.grid());
  EXPECT_EQ(rooms.storey.rooms.size(), 4U);
  EXPECT_EQ(rooms.storey.doors.size(), 3U);
}

TEST(Segmentation, aCorridorThatTurnsIsOneRoom) {
  PaintedPlan plan(10, 10);
  plan.room(0, 0, 10, 2).room(8, 0, 10, 10).free(7.5, 0, 8.5, 2);
  EXPECT_EQ(segmentRooms(plan.grid()).storey.rooms.size(), 1U);
}

TEST(Segmentation, theSameGridGivesTheSameRooms) {
  const auto first = segmentRooms(corridorWithRooms().grid()), second = segmentRooms(corridorWithRooms().grid());
  EXPECT_EQ(first.room_of_cell, second.room_of_cell);
  for (std::size_t i = 0; i < first.storey.doors.size(); ++i)
    EXPECT_EQ(first.storey.doors[i].confidence, second.storey.doors[i].confidence);
}

TEST(Segmentation, aRoomSeenInPartIsOpen) {
  PaintedPlan plan = twoRooms();
  plan.paint(GridCell::unknown, 5.5, -1, 8, 4);
  const Segmentation rooms = segmentRooms(plan.grid());
  ASSERT_EQ(rooms.storey.rooms.size(), 2U);
  const int right = roomAt(rooms, plan.grid(), 5, 1);
  for (const Room& room : rooms.storey.rooms) EXPECT_EQ(room.isOpen(), room.id == right) << room.openness;
}

TEST(Segmentation, outlinesAreCounterClockwiseAndInTheMap) {
  const PaintedPlan plan = twoRooms(0.05, 0.4);
  for (const Room& room : segmentRooms(plan.grid()).storey.rooms) {
    double twice = 0;
    for (std::size_t i = 0; i < room.outline.size(); ++i) {
      const Eigen::Vector2d &a = room.outline[i], &b = room.outline[(i + 1) % room.outline.size()];
      twice += a.x() * b.y() - a.y() * b.x();
      EXPECT_GT(a.x(), -0.2);
      EXPECT_LT(a.y(), 3.2);
    }
    EXPECT_NEAR(twice / 2, room.area, 0.1 * room.area);
  }
}

// OpenCV's exact distances are wrong in columns from 4096 on.
TEST(Segmentation, aGridOfThousandsOfColumnsHasItsRooms) {
  PaintedPlan plan(240, 3);
  plan.room(230, 0, 234, 3).room(234.1, 0, 237.1, 3).free(234, 1, 234.1, 1.9);
  const Segmentation rooms = segmentRooms(plan.grid());
  ASSERT_EQ(rooms.storey.rooms.size(), 2U);
  for (const Room& room : rooms.storey.rooms) EXPECT_NEAR(room.clearance, 1.5, 0.1);
}

TEST(Segmentation, oneRoomIsOneRoom) {
  PaintedPlan plan(5, 4);
  const auto rooms = segmentRooms(plan.room(0, 0, 5, 4).grid()).storey;
  ASSERT_EQ(rooms.rooms.size(), 1U);
  EXPECT_TRUE(rooms.doors.empty());
  EXPECT_GT(rooms.rooms.front().confidence, 0.9);
}

TEST(Segmentation, nothingFreeIsNoRoom) {
  EXPECT_TRUE(segmentRooms(PaintedPlan(5, 4).grid()).storey.rooms.empty());
  EXPECT_TRUE(segmentRooms(PaintedPlan(5, 4).thing(0, 0, 5, 4).grid()).storey.rooms.empty());
  PaintedPlan one_cell(1, 1);
  one_cell.grid().columns = one_cell.grid().rows = 1;
  one_cell.grid().cells = {GridCell::free};
  EXPECT_TRUE(segmentRooms(one_cell.grid()).storey.rooms.empty());
}

TEST(Segmentation, freeSpaceWithoutWallsIsOneOpenRoom) {
  PaintedPlan plan(20, 20);
  std::fill(plan.grid().cells.begin(), plan.grid().cells.end(), GridCell::free);
  const auto rooms = segmentRooms(plan.grid()).storey.rooms;
  ASSERT_EQ(rooms.size(), 1U);
  EXPECT_TRUE(rooms.front().isOpen());
}

TEST(Segmentation, thingsOutdoorsInventFewRooms) {
  PaintedPlan plan(40, 40);
  plan.free(0, 0, 40, 40);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(1, 38), size(0.2, 1.2);
  for (int tree = 0; tree < 40; ++tree) {
    const double x = place(random), y = place(random), side = size(random);
    plan.thing(x, y, x + side, y + side);
  }
  EXPECT_LE(segmentRooms(plan.grid()).storey.rooms.size(), 2U);
}

TEST(Segmentation, noiseAndHolesKeepTheRooms) {
  PaintedPlan plan = corridorWithRooms();
  std::mt19937 random(5);
  auto& grid = plan.grid();
  for (int i = 0; i < 400; ++i) {
    auto& cell = grid.cells[random() % grid.cells.size()];
    if (cell == GridCell::free) cell = i % 2 == 0 ? GridCell::occupied : GridCell::unknown;
  }
  plan.free(2, 6.1, 2.1, 6.3);  // a hole in the outer wall, to nowhere
  EXPECT_EQ(segmentRooms(grid).storey.rooms.size(), 4U);
}

TEST(Segmentation, aMazeIsCutIntoSomeRoomsAndLosesNoSpace) {
  PaintedPlan plan(12, 12);
  plan.room(0, 0, 12, 12);
  for (int wall = 1; wall < 8; ++wall) {
    const double x = 1.5 * wall;
    plan.thing(x, wall % 2 == 0 ? 0 : 1.4, x + 0.1, wall % 2 == 0 ? 10.6 : 12);
  }
  const auto rooms = segmentRooms(plan.grid()).storey.rooms;
  double area = 0;
  for (const Room& room : rooms) area += room.area;
  EXPECT_LE(rooms.size(), 8U);
  EXPECT_NEAR(area, 144 - 7 * 0.1 * 10.6, 1.5);
}

}  // namespace
}  // namespace omnimapper::building::segmentation_test

#include <gtest/gtest.h>
#include <omnimapper/query/Goal.h>

#include <cmath>

#include "HandMadeMap.h"

namespace omnimapper::query::goal_test {
namespace {

// Two rooms of 4 x 4 m in cells of 0.1 m, with a wall 0.2 m wide between them, from x = 4 to 4.2, and a door in it at y
// = 3 to 4. A wall of one cell surrounds them.
class TwoRooms : public ::testing::Test {
 protected:
  explicit TwoRooms(int door_cells = 10) {
    grid_.columns = 84;
    grid_.rows = 42;
    grid_.resolution = 0.1;
    grid_.map_from_grid = {-0.1, -0.1, 0};
    grid_.cells.assign(84 * 42, GridCell::free);
    for (int row = 0; row < 42; ++row) {
      for (int column = 0; column < 84; ++column) {
        const bool outside = row == 0 || row == 41 || column == 0 || column == 83;
        const bool between = (column == 41 || column == 42) && row < 41 - door_cells;
        if (outside || between) grid_.cells[grid_.indexOf({column, row})] = GridCell::occupied;
      }
    }
  }
  std::optional<Goal> goal(const map::Place& target, const Eigen::Vector2d& start,
                           const GoalOptions& options = {}) const {
    return goalBefore(target, start, RoomToMove(grid_, options.radius, start), grid_, options);
  }
  GridMap grid_;
};

TEST_F(TwoRooms, ASignWithANormalIsSeenFromStraightBefore) {
  map::Place sign = signAt(2, 0, "213");
  sign.normal = Eigen::Vector3d(0, 1, 0);
  const auto found = goal(sign, {1, 3});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 2, 1e-9);
  EXPECT_NEAR(found->y, 1, 1e-9);
  EXPECT_NEAR(found->yaw, -M_PI / 2, 1e-9);
  EXPECT_NEAR(found->distance, 1, 1e-9);
  EXPECT_TRUE(found->is_connected);
}

// On the wall between the rooms; the start is nearer to its other side.
TEST_F(TwoRooms, ASignOnAThinWallIsLookedAtFromItsFreeSide) {
  map::Place sign = signAt(4.2, 1.5, "214");
  sign.normal = Eigen::Vector3d(1, 0, 0);
  auto found = goal(sign, {3, 1.5});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 5.2, 1e-9);
  EXPECT_NEAR(std::abs(found->yaw), M_PI, 1e-9);
  EXPECT_TRUE(found->is_connected);
  sign.normal.reset();
  sign.seen_from = Eigen::Vector3d(std::sqrt(0.75), 0.5, 0);  // an oblique direction
  found = goal(sign, {3, 1.5});
  ASSERT_TRUE(found);
  EXPECT_GT(found->x, 4.6);
}

TEST_F(TwoRooms, ATableIsApproachedAtItsNearestEdge) {
  map::Place table;
  table.label = "table";
  table.normal = Eigen::Vector3d(0, 0, 1);
  table.extent.outlines = {{{2, 1}, {3, 1}, {3, 2}, {2, 2}}};
  const auto found = goal(table, {0.5, 1.5});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 1, 1e-9);
  EXPECT_NEAR(found->y, 1.5, 1e-9);
  EXPECT_NEAR(found->yaw, 0, 1e-9);
}

TEST_F(TwoRooms, AnotherDistanceIsTakenWhereOneMetreIsNotFree) {
  map::Place sign = signAt(2, 0, "213");
  sign.normal = Eigen::Vector3d(0, 1, 0);
  for (int column = 0; column < 84; ++column)  // only x = 1.5 to 2.5, y = 0 to 1.1 is known
    for (int row = 0; row < 42; ++row)
      if (row >= 12 || column < 16 || column >= 26) grid_.cells[grid_.indexOf({column, row})] = GridCell::unknown;
  const auto found = goal(sign, {2, 0.5});
  ASSERT_TRUE(found);
  EXPECT_LT(found->distance, 0.95);
  EXPECT_GT(found->distance, 0.45);
  EXPECT_LT(found->y, 0.9) << "0.25 m from what is not known";
}

TEST_F(TwoRooms, TheRobotNeedsItsRoom) {
  map::Place sign = signAt(2, 0, "213");
  sign.normal = Eigen::Vector3d(0, 1, 0);
  EXPECT_FALSE(goal(sign, {1, 1}, {1, 2.5})) << "no room is 5 m wide";
  const auto found = goal(sign, {1, 1}, {1, 1.2});
  ASSERT_TRUE(found);
  EXPECT_GE(found->y, 1.2);
}

class ClosedRooms : public TwoRooms {
 protected:
  ClosedRooms() : TwoRooms(0) {}
};

TEST_F(ClosedRooms, WhatIsNotConnectedIsSaidToBeSo) {
  map::Place sign = signAt(8.2, 2, "215");
  sign.normal = Eigen::Vector3d(-1, 0, 0);
  const auto found = goal(sign, {1, 1});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_connected);
  EXPECT_TRUE(goal(sign, {5, 1})->is_connected);
}

// A wall that can be seen from both rooms: the reachable side is chosen although the other one is as near.
TEST_F(ClosedRooms, OfTwoSidesThatOfTheStartIsTaken) {
  const map::Place wall = wallFrom(4.1, 0, 4.1, 4);
  const auto left = goal(wall, {1, 2}), right = goal(wall, {7, 2});
  ASSERT_TRUE(left && right);
  EXPECT_NEAR(left->x, 3.1, 1e-9);
  EXPECT_NEAR(right->x, 5.1, 1e-9);
  EXPECT_NEAR(left->y, 2, 1e-9);
}

TEST_F(ClosedRooms, TheStartMayBeAnywhere) {
  map::Place sign = signAt(2, 0, "213");
  for (const Eigen::Vector2d& start : {Eigen::Vector2d(1e9, -1e9), Eigen::Vector2d(2, 0), Eigen::Vector2d(4.1, 1)}) {
    const auto found = goal(sign, start);
    EXPECT_TRUE(found) << start.transpose();
  }
}

}  // namespace
}  // namespace omnimapper::query::goal_test

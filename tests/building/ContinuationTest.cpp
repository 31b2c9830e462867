#include <gtest/gtest.h>
#include <omnimapper/building/Continuation.h>

#include <set>

#include "PaintedPlan.h"

namespace omnimapper::building::continuation_test {
namespace {

int roomAt(const Segmentation& rooms, const grid::GridMap& grid, double x, double y) {
  return rooms.room_of_cell.at(grid.indexOf(grid.cellOf({x, y})));
}

Continuation grown(const Segmentation& before, const PaintedPlan& plan) {
  return continueRooms(before.storey, plan.grid(), segmentRooms(plan.grid()));
}

TEST(Continuation, theSameMapKeepsAllIds) {
  const PaintedPlan plan = corridorWithRooms();
  const Segmentation before = segmentRooms(plan.grid());
  const Continuation after = grown(before, plan);
  EXPECT_EQ(after.now.room_of_cell, before.room_of_cell);
  EXPECT_TRUE(after.gone.empty());
  for (std::size_t i = 0; i < before.storey.doors.size(); ++i)
    EXPECT_EQ(after.now.storey.doors[i].id, before.storey.doors[i].id);
}

TEST(Continuation, aRoomThatGrowsKeepsItsIdAndNewOnesGetNewIds) {
  PaintedPlan part = corridorWithRooms();
  part.paint(grid::GridCell::unknown, 6.5, -1, 13, 8);
  const Segmentation before = segmentRooms(part.grid());
  const PaintedPlan whole = corridorWithRooms();
  const Continuation after = grown(before, whole);
  for (const auto& [x, y] : {std::pair<double, double>(2, 1), {2, 4}, {5, 4}})
    EXPECT_EQ(roomAt(after.now, whole.grid(), x, y), roomAt(before, part.grid(), x, y)) << x << " " << y;
  EXPECT_EQ(roomAt(after.now, whole.grid(), 10, 4), before.storey.next_room);
  EXPECT_EQ(after.now.storey.next_room, before.storey.next_room + 1);
  EXPECT_TRUE(after.gone.empty());
}

TEST(Continuation, aWallThatAppearsSplitsARoomAndSaysSo) {
  PaintedPlan one(7.1, 3);
  one.room(0, 0, 7.1, 3);
  const Segmentation before = segmentRooms(one.grid());
  ASSERT_EQ(before.storey.rooms.size(), 1U);
  const PaintedPlan two = twoRooms();
  const Continuation after = grown(before, two);
  ASSERT_EQ(after.now.storey.rooms.size(), 2U);
  EXPECT_EQ(roomAt(after.now, two.grid(), 1, 1), 1) << "the larger part keeps the id";
  const Room& fresh = after.now.storey.rooms.back();
  EXPECT_EQ(fresh.id, 2);
  EXPECT_EQ(fresh.split_from, std::optional<int>(1));
  EXPECT_FALSE(after.now.storey.rooms.front().split_from.has_value());
}

TEST(Continuation, idsOfRoomsThatAreGoneAreNotUsedAgain) {
  const PaintedPlan two = twoRooms();
  const Segmentation before = segmentRooms(two.grid());
  PaintedPlan one(7.1, 3);
  one.room(0, 0, 7.1, 3);
  const Continuation joined = grown(before, one);
  ASSERT_EQ(joined.now.storey.rooms.size(), 1U);
  EXPECT_EQ(joined.gone.size(), 1U);
  const Continuation again = grown(joined.now, two);
  std::set<int> ids;
  for (const Room& room : again.now.storey.rooms) ids.insert(room.id);
  EXPECT_EQ(ids.count(joined.gone.front()), 0U);
  EXPECT_EQ(ids.count(3), 1U);
}

TEST(Continuation, aGridWithAnotherCornerIsTheSamePlace) {
  const PaintedPlan plan = corridorWithRooms();
  const Segmentation before = segmentRooms(plan.grid());
  const PaintedPlan turned = corridorWithRooms(0.05, 0.3);
  const Continuation after = grown(before, turned);
  for (const auto& [x, y] : {std::pair<double, double>(6, 1), {2, 4}, {6, 4}, {10, 4}})
    EXPECT_EQ(roomAt(after.now, turned.grid(), x, y), roomAt(before, plan.grid(), x, y));
}

TEST(Continuation, cornersFarAwayDoNoHarm) {
  const PaintedPlan plan = twoRooms();
  Segmentation before = segmentRooms(plan.grid());
  before.storey.rooms[0].outline = {{1e6, 1e300}, {-1e300, 0}, {0, -1e300}};
  EXPECT_EQ(grown(before, plan).now.storey.rooms.size(), 2U);
}

}  // namespace
}  // namespace omnimapper::building::continuation_test

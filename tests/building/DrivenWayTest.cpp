#include <gtest/gtest.h>
#include <omnimapper/building/DrivenWay.h>
#include <omnimapper/building/Segmentation.h>

#include "PaintedPlan.h"

namespace omnimapper::building::driven_way_test {
namespace {

TEST(DrivenWay, whatWasDrivenThroughIsNoWall) {
  PaintedPlan plan = twoRooms();
  plan.thing(4, 1, 4.1, 1.9);  // the door was closed most of the time
  ASSERT_TRUE(segmentRooms(plan.grid()).storey.doors.empty());
  freeDrivenWay(plan.grid(), {{2, 1.5}, {3.5, 1.5}, {4.5, 1.5}, {6, 1.5}}, 0.35);
  const auto storey = segmentRooms(plan.grid()).storey;
  ASSERT_EQ(storey.doors.size(), 1U);
  EXPECT_NEAR(geometry::middle(storey.doors[0].opening).y(), 1.5, 0.1);
  EXPECT_NEAR(storey.doors[0].width, 0.7, 0.1);
}

TEST(DrivenWay, onlyCellsWithinTheRadiusAreFreed) {
  PaintedPlan plan(4, 4);
  plan.thing(-1, -1, 5, 5);
  freeDrivenWay(plan.grid(), {{1, 2}, {2.5, 2}, {9, 2}}, 0.2);
  const auto at = [&](double x, double y) { return plan.grid().at(plan.grid().cellOf({x, y})); };
  EXPECT_EQ(at(1.8, 2), grid::GridCell::free);
  EXPECT_EQ(at(1.8, 2.12), grid::GridCell::free);
  EXPECT_EQ(at(1.8, 2.3), grid::GridCell::occupied);
  EXPECT_EQ(at(3.5, 2), grid::GridCell::occupied) << "nobody drove the 6.5 m between two key frames straight";
  const auto before = plan.grid().cells;
  freeDrivenWay(plan.grid(), {{-50, 70}}, 0.2);
  EXPECT_EQ(plan.grid().cells, before) << "outside of the grid";
}

}  // namespace
}  // namespace omnimapper::building::driven_way_test

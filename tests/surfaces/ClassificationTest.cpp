#include <gtest/gtest.h>
#include <omnimapper/surfaces/Classification.h>

namespace omnimapper::surfaces {

namespace {

using Eigen::Vector3d;

// Level, so high, `length` by `width` [m], with its first corner at x, y.
Surface level(double height, double length, double width, double x = 0, double y = 0) {
  Surface surface;
  surface.plane = {Vector3d::UnitZ(), -height};
  surface.parts.push_back(
      {{{x, y, height}, {x + length, y, height}, {x + length, y + width, height}, {x, y + width, height}}, {}});
  return surface;
}

// Upright at that y, free on the side of lower y, from x = `from` to `to` and from z = `bottom` to `top`.
Surface upright(double from, double to, double y, double bottom, double top) {
  Surface surface;
  surface.plane = {-Vector3d::UnitY(), y};
  surface.parts.push_back({{{from, y, bottom}, {to, y, bottom}, {to, y, top}, {from, y, top}}, {}});
  return surface;
}

SurfaceClass classOf(const Surface& surface, double floor = 0) {
  return classify({surface}, floor).front().is;
}

}  // namespace

TEST(Classify, LevelSurfacesByHeightAndSize) {
  EXPECT_EQ(classOf(level(0, 5, 4)), SurfaceClass::floor);
  EXPECT_EQ(classOf(level(0.74, 1.6, 0.9)), SurfaceClass::table);
  EXPECT_EQ(classOf(level(0.91, 2.4, 0.6)), SurfaceClass::counter);
  EXPECT_EQ(classOf(level(0.75, 1.6, 0.4)), SurfaceClass::cabinet);
  EXPECT_EQ(classOf(level(0.45, 0.45, 0.45)), SurfaceClass::seat);
  EXPECT_EQ(classOf(level(0.5, 1.6, 2.0)), SurfaceClass::bed);
}

TEST(Classify, HeightsCountFromTheFloor) {
  EXPECT_EQ(classOf(level(3.74, 1.6, 0.9), 3), SurfaceClass::table);
  EXPECT_EQ(classOf(level(3, 5, 4), 3), SurfaceClass::floor);
}

TEST(Classify, WhatIsSeenFromBelowIsACeilingOrAnUnderside) {
  Surface ceiling = level(2.6, 3, 3), underside = level(1.45, 1.8, 0.35);
  ceiling.plane = {-Vector3d::UnitZ(), 2.6};
  underside.plane = {-Vector3d::UnitZ(), 1.45};
  EXPECT_EQ(classOf(ceiling), SurfaceClass::ceiling);
  EXPECT_EQ(classOf(underside), SurfaceClass::cabinet);
}

TEST(Classify, UprightSurfacesByWhatTheyReach) {
  EXPECT_EQ(classOf(upright(0, 4, 3, 0, 2.5)), SurfaceClass::wall);
  EXPECT_EQ(classOf(upright(0, 0.9, 3, 0, 2.04)), SurfaceClass::door);
  EXPECT_EQ(classOf(upright(0, 0.15, 3, 0, 2.0)), SurfaceClass::door_frame);
  EXPECT_EQ(classOf(upright(0, 1.2, 3, 0, 0.8)), SurfaceClass::cabinet);
}

TEST(Classify, TheFrontOfAWardrobeStandsBeforeAWall) {
  const Surface front = upright(1, 2.8, 3, 0, 2.1), wall = upright(0, 4, 3.6, 0, 2.5);
  const auto both = classify({front, wall}, 0);
  EXPECT_EQ(both[0].is, SurfaceClass::cabinet);
  EXPECT_EQ(both[1].is, SurfaceClass::wall);
  EXPECT_NE(both[0].reason.find("close in front of a wall"), std::string::npos) << both[0].reason;
  // A wall of the next room is farther behind.
  EXPECT_EQ(classify({front, upright(0, 4, 6, 0, 2.5)}, 0)[0].is, SurfaceClass::wall);
}

TEST(Classify, TheSideOfABedTouchesIt) {
  const auto both = classify({upright(0, 2, 3, 0.1, 0.5), level(0.5, 2, 1.6, 0, 3)}, 0);
  EXPECT_EQ(both[0].is, SurfaceClass::bed);
  EXPECT_EQ(both[1].is, SurfaceClass::bed);
}

TEST(Classify, CornersThatStickOutCountForLittle) {
  Surface door = upright(0, 0.9, 3, 0, 2.04);
  door.parts.push_back({{{0.9, 3, 1}, {2, 3, 1}, {2, 3, 1.05}, {0.9, 3, 1.05}}, {}});  // 3 % of its area
  EXPECT_EQ(classOf(door), SurfaceClass::door);
}

TEST(Classify, WhatIsNotKnownIsASurfaceAndTheReasonIsGiven) {
  Surface tilted = level(1, 1, 1);
  tilted.plane = geometry::Plane3::through({0, 0, 1}, Vector3d(0, 0.7, 0.7).normalized());
  const auto judged = classify({tilted}, 0).front();
  EXPECT_EQ(judged.is, SurfaceClass::surface);
  EXPECT_EQ(judged.reason.rfind("tilted, ", 0), 0U) << judged.reason;
  EXPECT_EQ(classOf(level(1.9, 3, 3)), SurfaceClass::surface);
}

TEST(Classify, OneThatReachesToTheHorizonIsJudged) {
  EXPECT_EQ(classOf(level(0, 1e5, 1e5)), SurfaceClass::floor);
}

TEST(Classify, OfNothingThereIsNothing) {
  EXPECT_TRUE(classify({}, 0).empty());
  EXPECT_EQ(classOf(Surface{}), SurfaceClass::surface);
}

}  // namespace omnimapper::surfaces

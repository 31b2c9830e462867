#include <gtest/gtest.h>
#include <omnimapper/surfaces/ThingsOfFaces.h>

#include <Eigen/Geometry>
#include <cmath>

namespace omnimapper::surfaces::things_of_faces_test {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Surface quad(SurfaceClass is, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  Surface surface;
  surface.is = is;
  surface.plane = geometry::Plane3::through(a, (b - a).cross(c - b).normalized());
  surface.parts.push_back({{a, b, c, d}, {}});
  return surface;
}

/// Top, front and left side of a box whose corner is at the origin, free to lower x and y.
std::vector<Surface> box(SurfaceClass top, SurfaceClass sides, double length, double width, double height) {
  const Vector3d x(length, 0, 0), y(0, width, 0), z(0, 0, height), o(0, 0, 0);
  return {quad(top, z, z + x, z + x + y, z + y), quad(sides, o, x, x + z, z), quad(sides, y, o, z, z + y)};
}

std::vector<Surface> movedBy(double dx, double dy, double turn, const std::vector<Surface>& surfaces) {
  SurfaceSet set;
  set.surfaces = surfaces;
  return moved(set, {Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())), {dx, dy, 0}}).surfaces;
}

std::vector<Surface> joined(std::vector<Surface> a, const std::vector<Surface>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

TEST(Things, ABedThatLiesAskewHasItsSizeAlongItsOwnAxes) {
  const auto bed = movedBy(3, 2, 0.5, box(SurfaceClass::bed, SurfaceClass::bed, 2.0, 1.6, 0.5));
  const auto things = thingsOf(bed);
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things[0].is, SurfaceClass::bed);
  EXPECT_EQ(things[0].faces, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_NEAR(things[0].length, 2.0, 0.07);
  EXPECT_NEAR(things[0].width, 1.6, 0.07);
  EXPECT_NEAR(things[0].top, 0.5, 0.01);
  EXPECT_NEAR(things[0].bottom, 0, 0.03);
  EXPECT_NEAR(things[0].direction, 0.5, 0.02);
  const Vector2d middle = Vector2d(3, 2) + Eigen::Rotation2Dd(0.5) * Vector2d(1.0, 0.8);
  EXPECT_LT((things[0].middle - middle).norm(), 0.07);
}

TEST(Things, TheSidesOfACounterAreCalledCabinet) {
  const auto things = thingsOf(box(SurfaceClass::counter, SurfaceClass::cabinet, 2.4, 0.6, 0.9));
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things[0].is, SurfaceClass::counter);
}

TEST(Things, WhatStandsApartIsAnotherThing) {
  const auto one = box(SurfaceClass::cabinet, SurfaceClass::cabinet, 0.8, 0.4, 1);
  EXPECT_EQ(thingsOf(joined(one, movedBy(1.1, 0, 0, one))).size(), 2U);
}

TEST(Things, AChairAtATableIsNotTheTable) {
  const auto table = box(SurfaceClass::table, SurfaceClass::cabinet, 1.6, 0.9, 0.75);
  const auto chair = movedBy(0.4, -0.4, 0, box(SurfaceClass::seat, SurfaceClass::seat, 0.45, 0.45, 0.45));
  const auto things = thingsOf(joined(table, chair));
  ASSERT_EQ(things.size(), 2U);
  EXPECT_EQ(things[0].is, SurfaceClass::table);
  EXPECT_EQ(things[1].is, SurfaceClass::seat);
}

TEST(Things, WallsFloorsAndEmptySurfacesAreNone) {
  auto surfaces = box(SurfaceClass::floor, SurfaceClass::wall, 4, 3, 2.5);
  surfaces.emplace_back().is = SurfaceClass::table;
  EXPECT_TRUE(thingsOf(surfaces).empty());
  EXPECT_TRUE(thingsOf({}).empty());
}

TEST(Things, TheBoardsOfAShelfAreOne) {
  const auto board = [](double z) { return quad(SurfaceClass::shelf, {0, 0, z}, {1, 0, z}, {1, 0.3, z}, {0, 0.3, z}); };
  const auto things = thingsOf({board(0.4), board(0.8), board(1.2)});
  ASSERT_EQ(things.size(), 1U);
  EXPECT_NEAR(things[0].length, 1, 0.07);
  EXPECT_NEAR(things[0].width, 0.3, 0.07);
}

}  // namespace omnimapper::surfaces::things_of_faces_test

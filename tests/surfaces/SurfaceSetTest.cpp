#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "omnimapper/surfaces/SurfaceSet.h"

namespace omnimapper::surfaces {

namespace {

using Eigen::Vector3d;

// A wall 4 m wide and 2.5 m high at y = 3, seen from its side of lower y, with a window.
Surface wallWithWindow() {
  Surface wall;
  wall.id = 7;
  wall.name = "kitchen/wall_2";
  wall.body = "kitchen";
  wall.is = SurfaceClass::wall;
  wall.plane = {-Vector3d::UnitY(), 3};
  wall.parts.push_back(
      {{{0, 3, 0}, {4, 3, 0}, {4, 3, 2.5}, {0, 3, 2.5}}, {{{1, 3, 1}, {2, 3, 1}, {2, 3, 2}, {1, 3, 2}}}});
  return wall;
}

}  // namespace

class SurfaceFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) const {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string errorOf(const std::string& text) const {
    try {
      readSurfaces(write(text));
    } catch (const base::Error& error) {
      return error.what();
    }
    return "no error";
  }

  testing::ScratchFolder scratch_;
  std::string path_ = scratch_ / "surfaces.json";
};

TEST(SurfaceClass, NamesGoThereAndBack) {
  for (const auto one : allSurfaceClasses()) EXPECT_EQ(surfaceClassNamed(toString(one)), one);
  EXPECT_EQ(toString(SurfaceClass::door_frame), "door frame");
  EXPECT_FALSE(surfaceClassNamed("slope"));
}

TEST(CellGrid, OutlineLessHolesIsCoveredToTheCell) {
  const Surface wall = wallWithWindow();
  auto grid = CellGrid::around(wall.plane, cornersOf(wall), 0.05);
  EXPECT_EQ(grid.columns(), 80);
  EXPECT_EQ(grid.rows(), 50);
  grid.fill(wall.parts[0].outline, wall.parts[0].holes);
  EXPECT_NEAR(grid.area(), 9, 1e-9);
  EXPECT_NEAR(areaOf(wall), 9, 1e-9);
}

TEST(CellGrid, APointIsInTheCellWhoseMiddleIsNearest) {
  const Surface wall = wallWithWindow();
  const auto grid = CellGrid::around(wall.plane, cornersOf(wall), 0.05);
  const auto cell = grid.cellAt({1.01, 2.9, 1.99});  // its foot counts
  ASSERT_TRUE(cell);
  EXPECT_NEAR((grid.middleOf(*cell) - Vector3d(1.025, 3, 1.975)).norm(), 0, 1e-9);
  EXPECT_FALSE(grid.cellAt({4.01, 3, 1}));
  EXPECT_FALSE(grid.cellAt({std::numeric_limits<double>::quiet_NaN(), 3, 1}));
}

TEST(CellGrid, APolygonThatIsNotFiniteOrTooFarCoversNothing) {
  const geometry::Plane3 floor{Vector3d::UnitZ(), 0};
  const std::vector<Vector3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const double far : {std::nan(""), HUGE_VAL, 1.7e308, -1.7e308}) {
    const std::vector<Vector3d> nowhere{{0.5, 0.5, 0}, {far, 0.2, 0}, {0.2, -far, 0}};
    auto grid = CellGrid::around(floor, square, 0.1);
    grid.fill(nowhere);
    EXPECT_EQ(grid.count(), 0U);
    grid.fill(square, {nowhere});
    EXPECT_EQ(grid.count(), 100U);
  }
}

TEST(CellGrid, WhatHasNoSizeOrTooMuchIsRefused) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY();
  EXPECT_THROW(CellGrid(Vector3d::Zero(), x, y, 0, 1, 1), std::invalid_argument);
  EXPECT_THROW(CellGrid(Vector3d::Zero(), x, y, 1, 50'000, 50'000), std::invalid_argument);
  EXPECT_EQ(CellGrid::around({}, {}, 0.05).count(), 0u);
}

TEST_F(SurfaceFile, HoldsWhatWasWritten) {
  SurfaceSet set{"home", {wallWithWindow()}, {}};
  auto& wall = set.surfaces.front();
  wall.seen = CellGrid::around(wall.plane, cornersOf(wall), 0.05);
  wall.seen->fill({{0, 3, 0}, {2, 3, 0}, {2, 3, 1}, {0, 3, 1}});
  wall.is_moved = true;
  Opening door;
  door.name = "door_1";
  door.rooms = {"kitchen", "outside"};
  door.rectangle = {Vector3d(1, 0, 0), Vector3d(2, 0, 0), Vector3d(2, 0, 2), Vector3d(1, 0, 2)};
  door.leaf = Opening::Leaf::open;
  door.leaf_angle = 1.6;
  door.leaf_body = "door_1_leaf";
  set.openings.push_back(door);
  set.level = SurfaceSetLevel{{0, 0.6, 0.8}, "imu", 0.01};
  const auto read = readSurfaces(write(toJson(set)));
  EXPECT_EQ(toJson(read), toJson(set));
  EXPECT_EQ(read.level->from, "imu");
  EXPECT_EQ(read.level->up, Vector3d(0, 0.6, 0.8));
  EXPECT_NEAR(read.surfaces.front().seen->area(), 2, 1e-9);
  EXPECT_EQ(read.openings.front().leaf, Opening::Leaf::open);
  EXPECT_TRUE(read.surfaces.front().is_moved);
}

TEST_F(SurfaceFile, ATitleThatIsNotUtf8IsWrittenAllTheSame) {
  const auto read = readSurfaces(write(toJson({"caf\xe9", {wallWithWindow()}, {}})));
  EXPECT_EQ(read.title.substr(0, 3), "caf");
  EXPECT_EQ(read.surfaces.size(), 1U);
}

TEST_F(SurfaceFile, WhatLiesOffItsPlaneIsRefused) {
  SurfaceSet set{"home", {wallWithWindow()}, {}};
  set.surfaces.front().parts.front().outline.front() += 0.5 * set.surfaces.front().plane.normal;
  EXPECT_NE(errorOf(toJson(set)).find("surface 1: a corner lies 1 cm or more off its plane"), std::string::npos);
}

TEST_F(SurfaceFile, ErrorsNameFileAndPlace) {
  EXPECT_NE(errorOf("{").find(path_), std::string::npos);
  EXPECT_NE(errorOf("{\"format\": \"other\"}").find("is not 'omnimapper surfaces 1'"), std::string::npos);
  SurfaceSet set{"home", {wallWithWindow(), wallWithWindow()}, {}};
  std::string text = toJson(set);
  const auto at = text.rfind("\"wall\"");
  EXPECT_NE(errorOf(text.replace(at, 6, "\"moat\"")).find("surface 2: class 'moat' is not known"), std::string::npos);
  set.surfaces.front().plane.normal = {0, 0, 2};
  EXPECT_NE(errorOf(toJson(set)).find("surface 1: the normal"), std::string::npos);
  EXPECT_NE(errorOf("[]").find("the file"), std::string::npos);
}

}  // namespace omnimapper::surfaces

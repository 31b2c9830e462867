#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planes/LineSupport.h"

namespace omnimapper::plugins::line_support_test {

namespace {

using derived::Cell;
using Stretches = std::vector<LineSupport::Stretch>;

/// Cells of 0.1 m; the first row is y from 0 to 0.1 m, and x begins at 0. '#' is occupied, '.' free, else unknown.
derived::ScanGrid gridOf(const std::vector<std::string>& rows) {
  derived::ScanGrid grid;
  grid.columns = static_cast<int>(rows.front().size());
  grid.rows = static_cast<int>(rows.size());
  grid.resolution = 0.1;
  for (const auto& row : rows)
    for (const char c : row) grid.cells.push_back(c == '#' ? Cell::occupied : c == '.' ? Cell::free : Cell::unknown);
  return grid;
}

map::KeyFrames drivenThrough(const std::vector<Eigen::Vector2d>& way) {
  map::KeyFrames frames;
  for (const auto& at : way) {
    map::KeyFrame frame;
    frame.id = frames.nextId(0);
    frame.stamp = base::stampFromUnix(static_cast<double>(frames.size() + 1));
    frame.map_from_base = mrpt::poses::CPose3D(at.x(), at.y(), 0, 0, 0, 0);
    frames.insert(frame);
  }
  return frames;
}

/// The line of 2 m through the middle of the row with that index.
geometry::Segment2 alongRow(int row) {
  return {{0, 0.1 * row + 0.05}, {2, 0.1 * row + 0.05}};
}

}  // namespace

TEST(LineSupport, OfAWallIsAllOfIt) {
  const auto grid = gridOf({"....................", "####################", "                    "});
  const auto stretches = LineSupport(grid, {}).stretchesOf(alongRow(1));
  EXPECT_EQ(stretches.value(), (Stretches{{0, 2}}));
}

TEST(LineSupport, LegsInOneLineAreNone) {
  const auto grid = gridOf({"....................", "#....#....#....#....", "...................."});
  EXPECT_TRUE(LineSupport(grid, {}).stretchesOf(alongRow(1)).value().empty());
}

TEST(LineSupport, AnOpenDoorIsNotInTheWall) {
  const auto grid = gridOf({"....................", "#######......#######", "...................."});
  const auto stretches = LineSupport(grid, {}).stretchesOf(alongRow(1)).value();
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_DOUBLE_EQ(stretches[0].first, 0);
  EXPECT_NEAR(stretches[0].second, 0.7, 0.051);
  EXPECT_NEAR(stretches[1].first, 1.3, 0.051);
  EXPECT_DOUBLE_EQ(stretches[1].second, 2);
}

TEST(LineSupport, WhatHidesAWallLeavesIt) {
  const auto grid = gridOf({"....................", "######      ########", "                    "});
  EXPECT_EQ(LineSupport(grid, {}).stretchesOf(alongRow(1)).value(), (Stretches{{0, 2}}));
}

TEST(LineSupport, AWallIsCutWhereTheBaseDroveThroughIt) {
  const auto grid = gridOf({"....................", "####################", "...................."});
  const auto frames = drivenThrough({{1, -0.5}, {1, 0.5}});
  const auto stretches = LineSupport(grid, frames).stretchesOf(alongRow(1)).value();
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_NEAR(stretches[0].second, 0.85, 0.051);
  EXPECT_NEAR(stretches[1].first, 1.15, 0.051);
  EXPECT_EQ(LineSupport(grid, drivenThrough({{1, -0.5}, {1, 0.1}})).stretchesOf(alongRow(1)).value().size(), 1U);
}

TEST(LineSupport, NothingIsSaidOfWhatTheGridHasNotSeen) {
  const auto grid = gridOf({"....................", "                    ", "                    "});
  EXPECT_FALSE(LineSupport(grid, {}).stretchesOf({{0, 5}, {2, 5}}).has_value());
}

}  // namespace omnimapper::plugins::line_support_test

#include <gtest/gtest.h>

#include "object_landmarks/PointGrid.h"

namespace omnimapper::plugins::point_grid_test {
namespace {

TEST(PointGrid, KnowsTheCubesOfItsPoints) {
  PointGrid grid(0.1);
  EXPECT_TRUE(grid.add(Eigen::Vector3f(-0.05F, 0.05F, 0.05F)));
  EXPECT_FALSE(grid.add(Eigen::Vector3f(-0.01F, 0.01F, 0.09F))) << "the same cube";
  EXPECT_TRUE(grid.add(Eigen::Vector3f(0.05F, 0.05F, 0.05F))) << "the cube on the other side of 0";
  EXPECT_EQ(grid.size(), 2U);
  EXPECT_TRUE(grid.has({-0.09F, 0.01F, 0.01F}));
  EXPECT_FALSE(grid.has({-0.11F, 0.01F, 0.01F}));
  EXPECT_TRUE(grid.hasNear({-0.15F, 0.15F, -0.05F}));
  EXPECT_FALSE(grid.hasNear({-0.25F, 0.05F, 0.05F}));
}

TEST(PointGrid, SharesAreOfThePointsThatAreNear) {
  PointGrid grid(0.1);
  EXPECT_EQ(shareNear(grid, {{0, 0, 0}}), 0);
  EXPECT_EQ(shareNear(grid, {}), 0);
  grid.add(Eigen::Vector3f(0, 0, 0));
  EXPECT_DOUBLE_EQ(shareNear(grid, {{0, 0, 0}, {5, 0, 0}, {6, 0, 0}, {0.05F, 0, 0}}), 0.5);
  std::vector<Eigen::Vector3f> many(1000, Eigen::Vector3f(0, 0, 0));  // the first 700 are elsewhere
  for (std::size_t i = 0; i < 700; ++i) many[i].x() = 9;
  EXPECT_NEAR(shareNear(grid, many), 0.3, 0.01) << "200 of them are tried";
}

}  // namespace
}  // namespace omnimapper::plugins::point_grid_test

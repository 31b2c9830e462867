#include <gtest/gtest.h>

#include "objects/Fragments.h"

namespace omnimapper::perception::objects {
namespace {

TEST(Fragments, LegsAndPlinthsAreRodsBottlesAndPensAreNot) {
  EXPECT_TRUE(isRod({0.05, 0.04, 0.7}, 4)) << "a leg";
  EXPECT_TRUE(isRod({1.2, 0.02, 0.1}, 4)) << "a plinth";
  EXPECT_FALSE(isRod({0.08, 0.08, 0.33}, 4)) << "a bottle";
  EXPECT_FALSE(isRod({0.15, 0.01, 0.01}, 4)) << "a pen";
  EXPECT_FALSE(isRod({0.5, 0.2, 0.02}, 4)) << "a board";
  EXPECT_FALSE(isRod({0.05, 0.04, 0.7}, 20));
}

TEST(Fragments, APatchOfAWallIsARestOfItAndABoxBeforeItIsNot) {
  const geometry::Plane3 wall{-Eigen::Vector3d::UnitZ(), 2};  // at a depth of 2 m
  std::vector<Eigen::Vector3d> patch;
  for (int i = 0; i < 100; ++i) patch.emplace_back(0.01 * i, 0.002 * i, 2 + (i % 2 == 0 ? 0.01 : -0.01));
  const FragmentBounds bounds{0.01, 0.001};
  EXPECT_TRUE(isRestOfPlane(patch, {wall}, bounds));
  EXPECT_FALSE(isRestOfPlane(patch, {}, bounds));
  for (int i = 0; i < 21; ++i) patch[static_cast<std::size_t>(i)].z() = 1.8;
  EXPECT_FALSE(isRestOfPlane(patch, {wall}, bounds)) << "79 % of its points are on the wall";
}

}  // namespace
}  // namespace omnimapper::perception::objects

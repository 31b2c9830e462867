#include <gtest/gtest.h>

#include "Corners.h"

namespace omnimapper::signs {
namespace {

const Corners kBox = {Eigen::Vector2f(10, 20), {50, 20}, {50, 40}, {10, 40}};

TEST(Corners, hasHandWorkedMeasures) {
  EXPECT_FLOAT_EQ(heightOf(kBox), 20);
  EXPECT_FLOAT_EQ(widthOf(kBox), 40);
  EXPECT_FLOAT_EQ(areaOf(kBox), 800);
  EXPECT_EQ(middleOf(kBox), Eigen::Vector2f(30, 30));
  EXPECT_TRUE(contains(kBox, {11, 39}));
  EXPECT_FALSE(contains(kBox, {9, 30}));
  EXPECT_FALSE(contains(kBox, {30, 41}));
}

TEST(Corners, growsBySharesOfItsHeight) {
  const auto larger = grown(kBox, {0.5f, 1, 0.25f, 0});
  EXPECT_TRUE(larger[0].isApprox(Eigen::Vector2f(0, 15)));
  EXPECT_TRUE(larger[2].isApprox(Eigen::Vector2f(70, 40)));
}

}  // namespace
}  // namespace omnimapper::signs

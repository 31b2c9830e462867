#include <gtest/gtest.h>

#include <algorithm>

#include "planes/InverseDepth.h"
#include "road/GroundGrowth.h"

namespace omnimapper::perception::ground_growth_test {
namespace {

constexpr int kWidth = 96, kHeight = 112, kFoot = 60;  // [px]; the wall is above that row
constexpr double kSlope = 0.0014;                      // [1/m] of the ground from one row to the next
constexpr double kTolerance = 12 * kSlope;
constexpr double kNoSteps = 1e6;  // [sigma]
constexpr camera::Pinhole kCamera{500, 500, 47.5, 10};

// Ground with a wall on it. Seeds are below the wall's foot by the reach of the windows of normals.
planes::PixelLabels grown(const std::vector<std::uint8_t>& barred) {
  std::vector<float> depths;
  std::vector<std::uint8_t> seeds;
  for (int y = 0; y < kHeight; ++y) {
    depths.insert(depths.end(), kWidth, static_cast<float>(1 / (0.05 + kSlope * std::max(y, kFoot))));
    seeds.insert(seeds.end(), kWidth, y >= kFoot + 7);
  }
  const auto inverse = planes::invert(camera::DepthImage(depths.data(), kWidth, kHeight, kCamera), 0.4, 20);
  return road::growGround(inverse, kCamera, seeds, barred, {kTolerance / 4, kTolerance, kNoSteps, 16, 7});
}

bool isGround(const planes::PixelLabels& labels, int x, int y) {
  return labels.values[static_cast<std::size_t>(y * labels.stride + x)] != 0;
}

TEST(GroundGrowth, EndsAFewRowsAboveTheFootOfAWall) {
  const auto labels = grown(std::vector<std::uint8_t>(kWidth * kHeight, 0));
  for (int x = 0; x < kWidth; ++x) {
    for (int y = 0; y < kHeight; ++y) {
      if (y >= kFoot - 1) {
        EXPECT_TRUE(isGround(labels, x, y)) << x << " " << y;
      } else if (y <= kFoot - 5) {
        EXPECT_FALSE(isGround(labels, x, y)) << x << " " << y << ": by itself it might be ground";
      }
    }
  }
}

TEST(GroundGrowth, WhatIsBarredDoesNotGrowButSeedsStay) {
  const auto labels = grown(std::vector<std::uint8_t>(kWidth * kHeight, 1));
  for (int y = 0; y < kHeight; ++y) EXPECT_EQ(isGround(labels, 40, y), y >= kFoot + 7) << y;
}

}  // namespace
}  // namespace omnimapper::perception::ground_growth_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "road/HeightSteps.h"
#include "road/LineDifferences.h"

namespace omnimapper::perception::height_steps_test {
namespace {

constexpr int kWidth = 320, kHeight = 240;  // [px]
constexpr double kStep = 1e-5;              // [1/m]
constexpr double kSlope = 0.001;            // [1/m] of 1/z of the ground from one row to the next
constexpr double kBlockSigma = 100 * kStep;
// Height of a step of one standard deviation, in kStep: its sides are means of 38 blocks each.
const double kOneSigma = 100 * std::sqrt(2 / 38.);

using Offs = std::function<double(int x, int y)>;

road::LocalGround groundOf(const Offs& offs) {
  road::LocalGround ground;
  ground.width = kWidth;
  ground.height = kHeight;
  ground.step = kStep;
  ground.columns = kWidth / planes::kCell;
  ground.rows = kHeight / planes::kCell;
  ground.camera = {300, 300, 159.5, 20};
  ground.planes.assign(static_cast<std::size_t>(ground.columns * ground.rows), planes::ImagePlane{0, kSlope, 0.1});
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) ground.offs.push_back(static_cast<std::int16_t>(std::lround(offs(x, y))));
  }
  return ground;
}

/// The mask of the steps that are found with a threshold of 9 standard deviations.
class StepMask {
 public:
  explicit StepMask(const Offs& offs) : mask_(road::findHeightSteps(groundOf(offs), kBlockSigma, 9)) {}

  bool at(int x, int y) const { return mask_[static_cast<std::size_t>(y * kWidth + x)] != 0; }
  int count(const std::function<bool(int x, int y)>& of) const {
    int marked = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) marked += of(x, y) && at(x, y);
    }
    return marked;
  }
  /// Number of rows in which a pixel within one block of that column is of a step.
  int rowsNear(int column) const {
    int rows = 0;
    for (int y = 0; y < kHeight; ++y) {
      rows += count([&](int x, int of_row) { return of_row == y && std::abs(x + 0.5 - column) < 4; }) > 0;
    }
    return rows;
  }
  int count() const {
    return count([](int, int) { return true; });
  }

 private:
  std::vector<std::uint8_t> mask_;
};

// Blocks have 4 pixels; the line goes upright through block 40.
TEST(LineDifferences, DistinguishADiscontinuityFromASlopeIfMoreThanARowOfBlocksIsKnownOnEachSide) {
  const auto discontinuityBeside = [](const std::vector<int>& blocks_away) {
    const auto ground = groundOf([&](int x, int) {
      const int away = x / 4 - 40;
      const bool is_known = std::find(blocks_away.begin(), blocks_away.end(), std::abs(away)) != blocks_away.end();
      return is_known ? (away < 0 ? 0. : 120.) : static_cast<double>(road::LocalGround::kFarthest);
    });
    const auto upright = road::LineDirection::of(road::LineDirection::kCount / 2);
    EXPECT_NEAR(std::abs(upright.y), 1, 1e-9);
    return std::abs(road::LineDifferences(ground).discontinuityAt(40, 30, upright));
  };
  EXPECT_NEAR(discontinuityBeside({2, 3, 4}), 120, 1e-6);
  EXPECT_EQ(discontinuityBeside({2}), 0);
  EXPECT_EQ(discontinuityBeside({}), 0);
}

TEST(HeightSteps, AreFoundAlongTheirLineAndNowhereElse) {
  const StepMask mask([](int x, int) { return x < 160 ? 0 : 12 * kOneSigma; });
  EXPECT_GT(mask.rowsNear(160), kHeight - 20);
  EXPECT_EQ(mask.count([](int x, int) { return std::abs(x - 159.5) > 7; }), 0);
}

TEST(HeightSteps, LieAslantToo) {
  // Distance to the right of the line, across it.
  const auto across = [](int x, int y) { return ((x - 160) * 2 - (y - 120)) / std::sqrt(5.); };
  const StepMask mask([&](int x, int y) { return across(x, y) < 0 ? 0 : 15 * kOneSigma; });
  EXPECT_EQ(mask.count([&](int x, int y) { return std::abs(across(x, y)) > 11; }), 0);
  int rows = 0;
  for (int y = 30; y < kHeight - 30; ++y) {
    bool marked = false;
    for (int x = 0; x < kWidth; ++x) marked = marked || (std::abs(across(x, y)) < 4 && mask.at(x, y));
    rows += marked;
  }
  EXPECT_GT(rows, 170);
}

TEST(HeightSteps, AreAsWideAsAnUprightFaceIsHigh) {
  const double face = 14;  // [px]
  const double height = face * kSlope / kStep;
  const StepMask mask([&](int, int y) { return height * std::min(1., std::max(0., 0.5 + (120 - y) / face)); });
  for (int y = 120 - 5; y <= 120 + 5; ++y) {
    for (int x = 40; x < kWidth - 40; ++x) EXPECT_TRUE(mask.at(x, y)) << x << " " << y;
  }
  EXPECT_EQ(mask.count([](int, int y) { return std::abs(y - 120) > 14; }), 0);
}

TEST(HeightSteps, GoOnWhereTheyAreFaint) {
  EXPECT_EQ(StepMask([](int x, int) { return x < 160 ? 0 : 7 * kOneSigma; }).count(), 0);
  const StepMask strong([](int x, int y) { return x < 160 ? 0 : (y < 80 ? 12 : 7) * kOneSigma; });
  EXPECT_GT(strong.rowsNear(160), kHeight - 20);
  const StepMask ending([](int x, int y) { return x < 160 ? 0 : (y < 80 ? 12 : 4) * kOneSigma; });
  EXPECT_EQ(ending.count([](int, int y) { return y > 130; }), 0);
}

TEST(HeightSteps, SlopesAndBendsAreNone) {
  const double slope = 20;  // steps from one column to the next: a difference of 15 standard deviations
  EXPECT_EQ(StepMask([&](int x, int) { return slope * std::min(60, std::max(-60, x - 160)); }).count(), 0);
  EXPECT_EQ(StepMask([&](int, int y) { return slope * std::min(60, std::max(-60, y - 120)); }).count(), 0);
}

TEST(HeightSteps, WhatIsUnknownHasNone) {
  EXPECT_EQ(StepMask([](int, int) { return road::LocalGround::kUnknown; }).count(), 0);
  EXPECT_EQ(StepMask([](int x, int) { return x < 160 ? 0 : road::LocalGround::kUnknown; }).count(), 0);
}

}  // namespace
}  // namespace omnimapper::perception::height_steps_test

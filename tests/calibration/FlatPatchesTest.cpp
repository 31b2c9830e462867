#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "DistortedDepths.h"
#include "depth/DepthCells.h"
#include "depth/DistortionFit.h"
#include "depth/FlatPatches.h"

namespace omnimapper::calibration::flat_patches_test {
namespace {

using camera::DepthDistortion;

constexpr int kWidth = 160, kHeight = 120;

DepthCells cellsOfInverse(const std::function<double(double x, double y)>& inverse,
                          const std::function<void(std::vector<float>&)>& change = {}) {
  std::vector<float> metres;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u)
      metres.push_back(static_cast<float>(1 / inverse((2.0 * u + 1) / kWidth - 1, (2.0 * v + 1) / kHeight - 1)));
  }
  if (change) change(metres);
  return cellsOf(camera::DepthImage(metres.data(), kWidth, kHeight, {}));
}

double slanted(double x, double y) {
  return 0.5 + 0.1 * x - 0.2 * y;
}

TEST(DepthCells, DescribeTheirPlane) {
  const auto image = cellsOfInverse(slanted);
  ASSERT_EQ(image.columns, 40);
  ASSERT_EQ(image.rows, 30);
  for (const auto& cell : image.cells) {
    ASSERT_TRUE(cell.is_flat);
    EXPECT_NEAR(cell.inverse_depth, slanted(cell.x, cell.y), 1e-6);
    EXPECT_NEAR(cell.slope_x, 0.1, 1e-4);
    EXPECT_NEAR(cell.slope_y, -0.2, 1e-4);
  }
  EXPECT_NEAR(image.at(0, 0).x, -1 + 1.0 / 40, 1e-9);
  EXPECT_NEAR(image.at(39, 29).y, 1 - 1.0 / 30, 1e-9);
}

TEST(DepthCells, WhatIsNoMeasurementIsNotFlat) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  const float bad[] = {kNan, kInfinity, -kInfinity, -1, 0, 0.1F, 100};
  const auto image = cellsOfInverse(slanted, [&](std::vector<float>& metres) {
    for (std::size_t i = 0; i < 20 * kWidth; ++i) metres[i] = bad[i % 7];
    metres[30 * kWidth + 33] = kNan;  // a single bad pixel has no effect
  });
  for (int row = 0; row < image.rows; ++row) EXPECT_EQ(image.at(8, row).is_flat, row >= 5) << row;
  EXPECT_NEAR(image.at(8, 7).inverse_depth, slanted(image.at(8, 7).x, image.at(8, 7).y), 1e-6);
}

TEST(DepthCells, OfAnImageWithoutPixelsThereAreNone) {
  const auto none = cellsOf(camera::DepthImage(static_cast<const float*>(nullptr), 0, 0, {}));
  EXPECT_TRUE(none.cells.empty());
  EXPECT_TRUE(growPatches(none, {}, 0.01).empty());
}

TEST(DepthCells, ImagesDifferThatShowSomethingElse) {
  const auto here = cellsOfInverse(slanted);
  const auto nearer = cellsOfInverse([](double x, double y) { return slanted(x, y) + 0.02; });
  const auto noisy = cellsOfInverse([](double x, double y) { return slanted(x, y) + 0.001 * std::sin(900 * x * y); });
  const auto nothing = cellsOfInverse([](double, double) { return 1e-3; });
  EXPECT_TRUE(areDifferent(here, nearer));
  EXPECT_FALSE(areDifferent(here, noisy));
  EXPECT_TRUE(areDifferent(here, nothing));
  EXPECT_FALSE(areDifferent(nothing, nothing));
}

TEST(FlatPatches, WallAndFloorAreTwoAndADistortedWallIsOne) {
  const auto corner = [](double x, double y) { return std::max(0.4 + 0.05 * x, 0.3 + 0.5 * y); };
  EXPECT_EQ(growPatches(cellsOfInverse(corner), {}, 0.01).size(), 2U);
  const auto distortion = kinectDistortion();
  const auto distorted = [&](double x, double y) { return slanted(x, y) - distortion.at(x, y); };
  const auto patches = growPatches(cellsOfInverse(distorted), {}, 0.01);
  ASSERT_EQ(patches.size(), 1U);
  EXPECT_GT(patches.front().samples.size(), 1150U) << "of 1200 cells";
  for (const double miss : missesOf(patches.front(), distortion, 0.001)) EXPECT_LT(std::abs(miss), 5e-4);
}

TEST(FlatPatches, ASphereIsNone) {
  const auto sphere = [](double x, double y) { return 1 + 0.6 * (x * x + y * y); };
  for (const auto& patch : growPatches(cellsOfInverse(sphere), {}, 0.01)) EXPECT_LT(patch.samples.size(), 120U);
}

// The standard deviations agree with the scatter of estimates from many simulated logs.
TEST(DistortionFit, ReportsItsStandardDeviation) {
  constexpr int kTrials = 20, kPatches = 12;
  constexpr double kSigma = 0.001;  // [1/m]
  const auto truth = kinectDistortion();
  const std::vector<std::pair<double, double>> places{{0, 0}, {-0.8, -0.8}, {0.8, -0.5}, {0.3, 0.9}};
  double squares = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::mt19937 random(static_cast<unsigned>(trial));
    std::normal_distribution<double> noise(0, kSigma);
    std::vector<FlatPatch> patches;
    for (int p = 0; p < kPatches; ++p) {
      FlatPatch patch;
      patch.image = static_cast<std::size_t>(p);
      for (int i = 0; i < 200; ++i) {
        const double x = (2.0 * (i % 20) + 1) / 20 - 1, y = (2.0 * (i / 20) + 1) / 10 - 1;  // NOLINT
        patch.samples.push_back({x, y, 0.5 + 0.01 * p * x - 0.02 * y - truth.at(x, y) + noise(random)});
      }
      patches.push_back(std::move(patch));
    }
    const auto fit = fitDistortion(patches, 4, [] { return false; });
    EXPECT_NEAR(fit.scale, kSigma, 0.1 * kSigma);
    for (const auto& [x, y] : places)
      squares += std::pow((fit.distortion.at(x, y) - truth.at(x, y)) / fit.sigmaAt(x, y), 2);
  }
  const double rms = std::sqrt(squares / (kTrials * static_cast<double>(places.size())));
  EXPECT_GT(rms, 0.6);
  EXPECT_LT(rms, 1.6);
}

TEST(DistortionFit, WhereNothingWasSeenNothingIsKnown) {
  FlatPatch patch;
  for (int i = 0; i < 200; ++i) {
    const double x = -1 + 0.03 * (i % 20), y = (2.0 * (i / 20) + 1) / 10 - 1;  // NOLINT: the left third
    patch.samples.push_back({x, y, 0.5 + 0.1 * x});
  }
  std::vector<FlatPatch> patches(10, patch);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.001);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    patches[i].image = i;
    for (auto& sample : patches[i].samples) sample.inverse_depth += noise(random);
  }
  const auto fit = fitDistortion(patches, 4, [] { return false; });
  EXPECT_GT(fit.sigmaAt(0.9, 0.9), 0.005);
}

}  // namespace
}  // namespace omnimapper::calibration::flat_patches_test

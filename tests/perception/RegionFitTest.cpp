#include <gtest/gtest.h>
#include <omnimapper/perception/SameLabel.h>

#include <cmath>
#include <functional>

#include "planes/RegionFit.h"

namespace omnimapper::perception::planes::region_fit_test {
namespace {

constexpr int kWidth = 96, kHeight = 48;
constexpr camera::Pinhole kCamera{100, 100, 47.5, 23.5};

// Fits pixels of one label, whose plane is 1 m ahead, with 1/z [1/m] by column; columns [begin, end) have no label.
std::vector<FittedRegion> fitted(const std::function<double(int x)>& inverse_depth, int begin, int end) {
  std::vector<float> depths;
  PixelLabels labels{kWidth, kHeight, {}};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    depths.push_back(static_cast<float>(1 / inverse_depth(i % kWidth)));
    labels.values.push_back(i % kWidth < begin || i % kWidth >= end);
  }
  const auto inverse = invert(camera::DepthImage(depths.data(), kWidth, kHeight, kCamera), 0.4, 20);
  const auto components = connectComponents(kWidth, kHeight, SameLabel{labels.values.data()});
  CellRegions regions;
  regions.regions.push_back({{}, {0, 0, 1}});
  return fitRegions(inverse, kCamera, {}, components, labels, regions, 1);
}

TEST(RegionFit, PiecesOfOneLabelAtAnAngleAreEachFlat) {
  const auto pieces = fitted([](int x) { return 1 + 0.002 * std::abs(x - 47.5); }, 40, 50);
  ASSERT_EQ(pieces.size(), 2U);
  for (const auto& piece : pieces) {
    EXPECT_LT(piece.result.rms, 1e-6);
    EXPECT_NEAR(std::abs(piece.plane.a), 0.002, 1e-6);
  }
}

TEST(RegionFit, PixelsInOneLineHaveNoPlane) {
  const auto flat = [](int) { return 1.; };
  EXPECT_EQ(fitted(flat, 1, kWidth - 2).size(), 1U) << "one column on the left, two on the right";
  EXPECT_TRUE(fitted(flat, 1, kWidth).empty());
}

TEST(RegionFit, TheRmsIsThatOfTheDistancesFromThePlane) {
  // Columns are alternately 1 mm nearer and farther than 1 m.
  const auto wall = fitted([](int x) { return 1 / (x % 2 == 0 ? 0.999 : 1.001); }, 0, 0);
  ASSERT_EQ(wall.size(), 1U);
  EXPECT_NEAR(wall[0].result.rms, 0.001, 1e-5);
  EXPECT_NEAR(wall[0].result.roughness, 0.001 / std::sqrt(camera::DepthNoise().pixelVariance()), 1e-3);
}

}  // namespace
}  // namespace omnimapper::perception::planes::region_fit_test

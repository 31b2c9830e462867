#include <gtest/gtest.h>
#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/ColouredPlaneComparator.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::perception {
namespace {

const Pinhole kCamera{100, 100, 39.5, 31.5};
constexpr int kWidth = 80, kHeight = 64;

std::vector<float> cornerOfARoom() {
  std::vector<float> depth;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    depth.push_back(static_cast<float>(2 / (1 + std::abs(i % kWidth - 39.5) / 100)));
  }
  return depth;
}

// Sizes of components from the largest to the smallest that counts.
std::vector<int> sizes(const Components& components, int fewest) {
  std::vector<int> kept;
  for (const int pixels : components.pixels) {
    if (pixels >= fewest) kept.push_back(pixels);
  }
  std::sort(kept.rbegin(), kept.rend());
  return kept;
}

TEST(PlaneComparator, PartsTheWallsOfACorner) {
  const auto depth = cornerOfARoom();
  const DepthImage image(depth.data(), kWidth, kHeight, kCamera);
  const auto points = backProject(image);
  const auto normals = NormalEstimator({}).estimate(image);
  const auto walls = connectComponents(kWidth, kHeight, PlaneComparator{points, normals});
  const auto large = sizes(walls, 1000);
  ASSERT_EQ(large.size(), 2U);
  for (const int pixels : large) EXPECT_NEAR(pixels, kWidth * kHeight / 2, kHeight * 6);
}

TEST(ColouredPlaneComparator, PartsASheetFromTheTableItLiesOn) {
  const std::vector<float> depth(kWidth * kHeight, 1.F);
  const DepthImage image(depth.data(), kWidth, kHeight, kCamera);
  const auto points = backProject(image);
  const auto normals = NormalEstimator({}).estimate(image);
  std::vector<std::uint8_t> rgb(3 * depth.size(), 90);
  for (std::size_t y = 10; y < 30; ++y) {
    for (std::size_t x = 20; x < 50; ++x) rgb[3 * (y * kWidth + x) + 2] = 220;
  }
  const PlaneComparator plane{points, normals};
  EXPECT_EQ(connectComponents(kWidth, kHeight, plane).pixels, std::vector<int>{kWidth * kHeight});
  EXPECT_EQ(sizes(connectComponents(kWidth, kHeight, ColouredPlaneComparator{plane, rgb.data()}), 1),
            (std::vector<int>{kWidth * kHeight - 600, 600}));
}

TEST(ClusterComparator, PartsThingsOnceTheirTableIsMasked) {
  // Two blocks stand before a wall, and touch it in the image.
  std::vector<float> depth(kWidth * kHeight, 1.F);
  std::vector<std::uint16_t> labels(depth.size(), 1);
  for (std::size_t y = 20; y < 30; ++y) {
    for (const std::size_t x : {10U, 11U, 12U, 13U, 40U, 41U}) {
      depth[y * kWidth + x] = 0.99F;
      labels[y * kWidth + x] = 0;
    }
  }
  const auto points = backProject(DepthImage(depth.data(), kWidth, kHeight, kCamera));
  const std::vector<bool> none{false, false}, wall{false, true};
  EXPECT_EQ(connectComponents(kWidth, kHeight, ClusterComparator{points, labels, none}).pixels.size(), 1U);
  EXPECT_EQ(connectComponents(kWidth, kHeight, ClusterComparator{points, labels, wall}).pixels,
            (std::vector<int>{40, 20}));
}

TEST(ClusterComparator, AGapInDepthPartsThings) {
  std::vector<float> depth(kWidth * kHeight, 1.F);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = i % kWidth < 30 ? 1.F : 1.1F;
  const auto points = backProject(DepthImage(depth.data(), kWidth, kHeight, kCamera));
  const std::vector<std::uint16_t> labels(depth.size(), 0);
  const std::vector<bool> masked{false};
  EXPECT_EQ(connectComponents(kWidth, kHeight, ClusterComparator{points, labels, masked}).pixels,
            (std::vector<int>{30 * kHeight, 50 * kHeight}));
}

}  // namespace
}  // namespace omnimapper::perception

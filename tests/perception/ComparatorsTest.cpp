#include <gtest/gtest.h>
#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/ColouredPlaneComparator.h>
#include <omnimapper/perception/PlaneComparison.h>
#include <omnimapper/perception/SmoothComparator.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::perception::comparators_test {
namespace {

const camera::Pinhole kCamera{100, 100, 39.5, 31.5};
constexpr int kWidth = 80, kHeight = 64;

std::vector<float> cornerOfARoom() {
  std::vector<float> depth;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    depth.push_back(static_cast<float>(2 / (1 + std::abs(i % kWidth - 39.5) / 100)));
  }
  return depth;
}

// Sizes of the components with at least `fewest` pixels, the largest first.
std::vector<int> sizes(const Components& components, int fewest) {
  std::vector<int> kept;
  for (const int pixels : components.pixels) {
    if (pixels >= fewest) kept.push_back(pixels);
  }
  std::sort(kept.rbegin(), kept.rend());
  return kept;
}

TEST(SmoothComparator, PartsTheWallsOfACorner) {
  const auto depth = cornerOfARoom();
  const camera::DepthImage image(depth.data(), kWidth, kHeight, kCamera);
  const auto points = backProject(image);
  const auto normals = NormalEstimator({}).estimate(image);
  const auto walls = connectComponents(kWidth, kHeight, SmoothComparator{points, normals});
  const auto large = sizes(walls, 1000);
  ASSERT_EQ(large.size(), 2U);
  for (const int pixels : large) EXPECT_NEAR(pixels, kWidth * kHeight / 2, kHeight * 6);
}

/// A grey picture, all of it on plane 1.
struct Greys {
  explicit Greys(int columns, const std::vector<std::uint8_t>& values) : width(columns), planes(values.size(), 1) {
    for (const std::uint8_t v : values) colours.push_back({v, v, v});
  }
  PlanePixels pixels() const { return {width, static_cast<int>(planes.size()) / width, planes.data(), colours.data()}; }
  int width;
  std::vector<std::uint16_t> planes;
  std::vector<obs::Rgb> colours;
};

std::vector<std::int32_t> labelsOf(const Greys& greys, double max_distance = 30) {
  const PlanePixels pixels = greys.pixels();
  return connectComponents(pixels.width, pixels.height, ColouredPlaneComparator{pixels, max_distance}).labels();
}

TEST(ColouredPlaneComparator, LeavesOutWhatIsBesideAnEdgeAsWorkedByHand) {
  EXPECT_EQ(labelsOf(Greys(9, {50, 50, 50, 50, 99, 99, 99, 99, 99})), (std::vector<int>{1, 1, 0, 0, 0, 0, 2, 2, 2}));
  EXPECT_EQ(labelsOf(Greys(1, {50, 50, 50, 50, 99, 99, 99, 99, 99})), (std::vector<int>{1, 1, 0, 0, 0, 0, 2, 2, 2}));
}

TEST(ColouredPlaneComparator, AnEdgeThatIsFourPixelsWideIsOne) {
  // No two neighbours differ by more than 10 in each channel, 17 in all; across four pixels it is 69.
  EXPECT_EQ(labelsOf(Greys(10, {50, 50, 50, 60, 70, 80, 90, 90, 90, 90})),
            (std::vector<int>{1, 1, 0, 0, 0, 0, 0, 2, 2, 2}));
}

TEST(ColouredPlaneComparator, LightThatChangesSlowlyPartsNothing) {
  // Each channel changes by 4 a pixel: 16 sqrt(3) = 27.7 from two pixels before to two behind, 140 from end to end.
  std::vector<std::uint8_t> ramp;
  for (std::uint8_t i = 0; i < 36; ++i) ramp.push_back(static_cast<std::uint8_t>(50 + 4 * i));
  EXPECT_EQ(labelsOf(Greys(36, ramp)), std::vector<int>(36, 1));
}

TEST(ColouredPlaneComparator, TheDistanceIsEuclideanInRgb) {
  Greys greys(4, {50, 50, 50, 50});
  greys.colours[2] = greys.colours[3] = {53, 54, 62};  // 3, 4 and 12: 13 in all
  EXPECT_EQ(labelsOf(greys, 13), (std::vector<int>{1, 1, 1, 1}));
  EXPECT_EQ(labelsOf(greys, 12.9), (std::vector<int>{0, 0, 0, 0})) << "each is beside the edge";
}

TEST(ColouredPlaneComparator, LooksAtNoOtherPlaneAndNotRoundTheImagesEdge) {
  Greys two(6, {50, 50, 50, 200, 200, 200, 50, 50, 50, 200, 200, 200});
  two.planes = {1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2};
  EXPECT_EQ(labelsOf(two), (std::vector<int>{1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2}));
  two.planes[1] = two.planes[7] = 0;
  EXPECT_EQ(labelsOf(two), (std::vector<int>{1, 0, 2, 3, 3, 3, 1, 0, 2, 3, 3, 3})) << "on none";
}

TEST(ConnectPieces, BordersSpecksAndThinPrintJoinWhatIsBesideThem) {
  // Two sheets side by side, with a line of print and a speck on the left one.
  const int width = 16, height = 12;
  std::vector<std::uint8_t> values;
  for (int i = 0; i < width * height; ++i) values.push_back(i % width < 8 ? 50 : 150);
  for (int y = 3; y < 9; ++y) values[static_cast<std::size_t>(y * width + 3)] = 0;
  values[0] = 255;
  const Greys sheets(width, values);
  const auto pieces = connectPieces(sheets.pixels(), ColouredPlaneComparator{sheets.pixels()});
  EXPECT_EQ(pieces.pixels, (std::vector<int>{8 * height, 8 * height}));
}

TEST(ConnectPieces, APatchTooLargeForASpeckIsAPieceOfItsOwn) {
  const int width = 40, height = 40;
  std::vector<std::uint8_t> values(static_cast<std::size_t>(width * height), 200);
  for (int y = 10; y < 22; ++y) {
    for (int x = 10; x < 20; ++x) values[static_cast<std::size_t>(y * width + x)] = 20;
  }
  const Greys sheet(width, values);
  const auto pieces = connectPieces(sheet.pixels(), ColouredPlaneComparator{sheet.pixels()});
  EXPECT_EQ(pieces.pixels, (std::vector<int>{width * height - 120, 120})) << "to the pixel";
}

TEST(GrowLabels, RingByRingAsWorkedByHand) {
  const std::vector<std::uint16_t> planes{1, 1, 1, 1, 1, 1, 0, 2, 2};
  std::vector<std::int32_t> labels{0, 5, 0, 0, 0, 0, 0, 0, 7};
  growLabels(9, 1, SameLabel{planes.data()}, 2, labels);
  EXPECT_EQ(labels, (std::vector<int>{5, 5, 5, 5, 0, 0, 0, 7, 7}));
  growLabels(9, 1, SameLabel{planes.data()}, 100, labels);
  EXPECT_EQ(labels, (std::vector<int>{5, 5, 5, 5, 5, 5, 0, 7, 7}));
}

TEST(ClusterComparator, SeparatesObjectsOnceTheirTableIsMasked) {
  // Two blocks stand before a wall, and touch it in the image.
  std::vector<float> depth(kWidth * kHeight, 1.F);
  std::vector<std::uint16_t> labels(depth.size(), 1);
  for (std::size_t y = 20; y < 30; ++y) {
    for (const std::size_t x : {10U, 11U, 12U, 13U, 40U, 41U}) {
      depth[y * kWidth + x] = 0.99F;
      labels[y * kWidth + x] = 0;
    }
  }
  const auto points = backProject(camera::DepthImage(depth.data(), kWidth, kHeight, kCamera));
  const std::vector<std::uint8_t> none{0, 0}, wall{0, 1};
  EXPECT_EQ(connectComponents(kWidth, kHeight, ClusterComparator{points, labels, none}).pixels.size(), 1U);
  EXPECT_EQ(connectComponents(kWidth, kHeight, ClusterComparator{points, labels, wall}).pixels,
            (std::vector<int>{40, 20}));
}

TEST(ClusterComparator, AGapInDepthSeparatesObjects) {
  std::vector<float> depth(kWidth * kHeight, 1.F);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = i % kWidth < 30 ? 1.F : 1.1F;
  const auto points = backProject(camera::DepthImage(depth.data(), kWidth, kHeight, kCamera));
  const std::vector<std::uint16_t> labels(depth.size(), 0);
  const std::vector<std::uint8_t> masked{0};
  EXPECT_EQ(connectComponents(kWidth, kHeight, ClusterComparator{points, labels, masked}).pixels,
            (std::vector<int>{30 * kHeight, 50 * kHeight}));
}

}  // namespace
}  // namespace omnimapper::perception::comparators_test

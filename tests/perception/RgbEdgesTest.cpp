// Canny's edges of pictures, where there is depth.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace omnimapper::perception::rgb_edges_test {
namespace {

const camera::Pinhole kCamera{100, 100, 39.5, 31.5};
using Bytes = std::vector<std::uint8_t>;

Bytes rgbEdges(const camera::ColourImage& colour, const std::vector<float>& depth, EdgeOptions options = {}) {
  options.jumps = options.high_curvature = false;
  return EdgeDetector(options)
      .detect(camera::DepthImage(depth.data(), colour.width, colour.height, kCamera), colour)
      .labels;
}

std::vector<float> wall(int pixels) {
  return std::vector<float>(static_cast<std::size_t>(pixels), 1.F);
}

// A plain implementation of Canny's detector, for comparison.
class PlainCanny {
 public:
  PlainCanny(const Bytes& grey, int width, int height) : grey_(grey), width_(width), height_(height) {}

  Bytes find(int low, int high) const {
    Bytes edges(grey_.size(), 0);
    for (bool grown = true; grown;) {
      grown = false;
      for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
          std::uint8_t& here = edges[index(x, y)];
          if (here != 0 || size(x, y) <= low || !isLargest(x, y)) continue;
          if (size(x, y) <= high && !besideOne(edges, x, y)) continue;
          here = kRgb;
          grown = true;
        }
      }
    }
    return edges;
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * width_ + x); }
  int grey(int x, int y) const { return grey_[index(std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1))]; }
  int across(int x, int y) const {
    int sum = 0;
    for (int k = -1; k <= 1; ++k) sum += (2 - std::abs(k)) * (grey(x + 1, y + k) - grey(x - 1, y + k));
    return sum;
  }
  int down(int x, int y) const {
    int sum = 0;
    for (int k = -1; k <= 1; ++k) sum += (2 - std::abs(k)) * (grey(x + k, y + 1) - grey(x + k, y - 1));
    return sum;
  }
  int size(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0;
    return std::abs(across(x, y)) + std::abs(down(x, y));
  }
  bool isLargest(int x, int y) const {
    const int gx = across(x, y), gy = down(x, y), here = size(x, y);
    const double slope = std::abs(gy) / std::max(1e-9, 1.0 * std::abs(gx));
    if (slope < std::tan(M_PI / 8)) return here > size(x - 1, y) && here >= size(x + 1, y);
    if (slope > std::tan(3 * M_PI / 8)) return here > size(x, y - 1) && here >= size(x, y + 1);
    const int side = (gx < 0) == (gy < 0) ? 1 : -1;
    return here > size(x - side, y - 1) && here > size(x + side, y + 1);
  }
  bool besideOne(const Bytes& edges, int x, int y) const {
    for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v) {
      for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
        if (edges[index(u, v)] != 0) return true;
      }
    }
    return false;
  }

  const Bytes& grey_;
  int width_, height_;
};

TEST(RgbEdges, AreThoseOfCannyAsItIsWrittenDown) {
  testing::Dice dice(7);
  for (const int width : {1, 2, 5, 15, 16, 17, 33, 80}) {
    for (const int height : {1, 2, 3, 40}) {
      Bytes grey;
      for (int i = 0; i < width * height; ++i) {
        const bool light = (i % width / 7 + i / width / 9) % 2 == 0;
        grey.push_back(static_cast<std::uint8_t>((light ? 150 : 90) + dice.uniform(-12, 12)));
      }
      const camera::ColourImage image{grey.data(), width, height, width, camera::ColourImage::Order::grey};
      EXPECT_EQ(rgbEdges(image, wall(width * height)), PlainCanny(grey, width, height).find(40, 100))
          << width << " x " << height;
    }
  }
}

TEST(RgbEdges, OfASheetAreItsBorderWhereThereIsDepth) {
  constexpr int kWidth = 40, kHeight = 30;
  for (const auto order : {camera::ColourImage::Order::rgb, camera::ColourImage::Order::bgr}) {
    Bytes colour(3 * kWidth * kHeight, 20);
    for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
      if (i % kWidth >= 20) std::fill_n(colour.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, std::uint8_t{220});
    }
    auto depth = wall(kWidth * kHeight);
    for (std::size_t y = 0; y < 10; ++y)
      std::fill_n(depth.begin() + static_cast<std::ptrdiff_t>(y * kWidth), kWidth, 0.F);
    const auto labels = rgbEdges({colour.data(), kWidth, kHeight, 3 * kWidth, order}, depth);
    for (int i = 0; i < kWidth * kHeight; ++i) {
      // Columns 19 and 20 have the same gradient: the first one counts.
      EXPECT_EQ(labels[static_cast<std::size_t>(i)], i % kWidth == 19 && i / kWidth >= 10 ? kRgb : 0) << i;
    }
  }
}

TEST(RgbEdges, RowsMayHaveGapsBetweenThem) {
  Bytes padded(4 * 20, 255);
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 9; ++x) padded[20 * y + x] = x < 5 ? 10 : 100;
  }
  const auto labels = rgbEdges({padded.data(), 9, 4, 20, camera::ColourImage::Order::grey}, wall(36));
  for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(labels[i] != 0, i % 9 == 4) << i;
}

TEST(RgbEdges, AFaintEdgeCountsOnlyWhereItGoesOnFromAStrongOne) {
  constexpr int kWidth = 32, kHeight = 60;
  Bytes grey(kWidth * kHeight, 100);
  for (std::size_t y = 0; y < kHeight; ++y) {
    for (std::size_t x = 16; x < kWidth; ++x) grey[y * kWidth + x] = y < 20 ? 100 : y < 40 ? 115 : 160;
  }
  const camera::ColourImage image{grey.data(), kWidth, kHeight, kWidth, camera::ColourImage::Order::grey};
  const auto labels = rgbEdges(image, wall(kWidth * kHeight));
  EXPECT_EQ(labels[30 * kWidth + 15], kRgb);
  EdgeOptions strong;
  strong.rgb_low = 100;
  EXPECT_EQ(rgbEdges(image, wall(kWidth * kHeight), strong)[30 * kWidth + 15], 0);
}

TEST(RgbEdges, APictureOfAnotherSizeIsRefused) {
  const Bytes colour(3 * 40 * 30, 0);
  const auto depth = wall(40 * 31);
  const camera::DepthImage image(depth.data(), 40, 31, kCamera);
  EXPECT_THROW(EdgeDetector({}).detect(image, {colour.data(), 40, 30, 120, camera::ColourImage::Order::rgb}),
               base::Error);
  EXPECT_THROW(EdgeDetector({}).detect(image, camera::ColourImage()), base::Error);
}

TEST(RgbEdges, AnEmptyPictureHasNone) {
  const camera::DepthImage nothing(static_cast<const float*>(nullptr), 0, 0, kCamera);
  EXPECT_TRUE(EdgeDetector({}).detect(nothing, camera::ColourImage()).labels.empty());
}

}  // namespace
}  // namespace omnimapper::perception::rgb_edges_test

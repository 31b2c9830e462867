#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/EdgeDetector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <thread>
#include <vector>

#include "DepthRooms.h"

namespace omnimapper::perception::edge_detector_test {
namespace {

const camera::Pinhole kCamera{100, 100, 39.5, 31.5};
constexpr int kWidth = 80, kHeight = 64;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Shot {
  std::vector<float> depth;
  EdgeImage edges;

  unsigned at(int x, int y) const { return edges.labels[static_cast<std::size_t>(y * edges.width + x)]; }
  /// Columns of row y with a kind.
  std::set<int> columns(int y, unsigned kinds) const {
    std::set<int> found;
    for (int x = 0; x < edges.width; ++x) {
      if ((at(x, y) & kinds) != 0) found.insert(x);
    }
    return found;
  }
  int count(unsigned kinds) const {
    return static_cast<int>(
        std::count_if(edges.labels.begin(), edges.labels.end(), [&](std::uint8_t l) { return (l & kinds) != 0; }));
  }
};

template <class Depth>
Shot shoot(const Depth& depth, const EdgeOptions& options = {}, int width = kWidth, int height = kHeight) {
  Shot shot;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) shot.depth.push_back(static_cast<float>(depth(x, y)));
  }
  shot.edges = EdgeDetector(options).detect(camera::DepthImage(shot.depth.data(), width, height, kCamera));
  return shot;
}

constexpr unsigned kDiscontinuities = kOccluding | kOccluded | kBoundary;
using Columns = std::set<int>;

TEST(EdgeDetector, ADepthDiscontinuityHasAnOccludingAndAnOccludedSide) {
  const auto shot = shoot([](int x, int) { return x < 40 ? 1 : 1.5; });
  for (int y = 0; y < kHeight; ++y) {
    EXPECT_EQ(shot.columns(y, kOccluding), Columns{39});
    EXPECT_EQ(shot.columns(y, kOccluded), Columns{40});
  }
  EXPECT_EQ(shot.count(kBoundary | kHighCurvature | kRgb), 0);
}

TEST(EdgeDetector, NeighboursAreThoseAtCornersToo) {
  const auto shot = shoot([](int x, int y) { return x == 20 && y == 30 ? 1 : 2; });
  EXPECT_EQ(shot.count(kOccluding), 1);
  EXPECT_EQ(shot.count(kOccluded), 8);
  for (int y = 29; y <= 31; ++y) {
    for (int x = 19; x <= 21; ++x) EXPECT_EQ(shot.at(x, y), x == 20 && y == 30 ? kOccluding : kOccluded);
  }
}

TEST(EdgeDetector, ADepthDiscontinuityOverAHoleIsFoundAlongRowsAndColumns) {
  for (const double nothing : {0.0, static_cast<double>(kNan), -1.0, 65535.0}) {
    const auto row = shoot([&](int x, int) { return x < 30 ? 1 : x < 40 ? nothing : 2; });
    EXPECT_EQ(row.columns(10, kOccluding), Columns{29});
    EXPECT_EQ(row.columns(10, kOccluded), Columns{40});
    EXPECT_EQ(row.count(kBoundary), 0);
    const auto column = shoot([&](int, int y) { return y < 20 ? 2 : y < 25 ? nothing : 1; });
    EXPECT_EQ(column.at(5, 19), kOccluded);
    EXPECT_EQ(column.at(5, 25), kOccluding);
    EXPECT_EQ(column.count(kDiscontinuities), 2 * kWidth);
  }
}

TEST(EdgeDetector, AHoleInAWallIsNoEdgeUnlessItIsTooWide) {
  const auto hole = [](int x, int y) { return x >= 30 && x < 41 && y >= 20 && y < 31 ? 0 : 1.5; };
  EXPECT_EQ(shoot(hole).count(~0U), 0);
  EdgeOptions narrow;
  narrow.max_hole = 10;
  const auto shot = shoot(hole, narrow);
  EXPECT_EQ(shot.columns(25, kBoundary), (Columns{29, 41}));
  EXPECT_EQ(shot.count(kBoundary), 4 * 11);
  EXPECT_EQ(shot.count(~0U), 4 * 11);
}

TEST(EdgeDetector, AHoleThatReachesTheBorderIsABoundaryAndTheBorderIsNone) {
  const auto shot = shoot([](int x, int y) { return x >= 70 || y < 3 ? 0 : 1; });
  EXPECT_EQ(shot.columns(3, kBoundary).size(), 70U);
  EXPECT_EQ(shot.columns(40, kBoundary), Columns{69});
  EXPECT_EQ(shot.count(~0U), 70 + kHeight - 4);
}

TEST(EdgeDetector, ObliqueSurfacesHaveNoDepthDiscontinuity) {
  // 1/z falls by 0.02 a pixel, more than the noise explains, and has a hole.
  EdgeOptions options;
  options.relative_jump = 0;
  const auto whole =
      shoot([](int x, int y) { return y > 20 && y < 50 && x > 30 && x < 36 ? 0 : 1 / (2 - 0.02 * x); }, options);
  // In the very corners edges are undetermined.
  for (int y = 3; y < kHeight - 3; ++y) EXPECT_EQ(whole.columns(y, kDiscontinuities), Columns{}) << y;
  // The same surface with a step up and a step down.
  for (const double step : {0.1, -0.1}) {
    const auto shot = shoot([&](int x, int) { return 1 / (2 - 0.02 * x + (x < 40 ? 0 : step)); });
    EXPECT_EQ(shot.columns(10, step < 0 ? kOccluding : kOccluded), Columns{39});
    EXPECT_EQ(shot.columns(10, step < 0 ? kOccluded : kOccluding), Columns{40});
  }
}

TEST(EdgeDetector, TheSmallestDepthDiscontinuityGrowsWithTheNoiseAndWithTheDepth) {
  EdgeOptions options;
  options.relative_jump = 0;
  // Three standard deviations of the difference of two pixels, in 1/z.
  const double least = 3 * std::sqrt(2 * options.noise().pixelVariance());
  for (const double z : {1.0, 3.0}) {
    for (const double part : {0.9, 1.1}) {
      const auto shot = shoot([&](int x, int) { return x < 40 ? z : 1 / (1 / z - part * least); }, options);
      EXPECT_EQ(shot.count(kOccluding), part > 1 ? kHeight : 0) << z << " " << part;
    }
  }
  options.relative_jump = 0.1;
  EXPECT_EQ(shoot([](int x, int) { return x < 40 ? 1 : 1.1; }, options).count(kOccluding), 0);
  EXPECT_EQ(shoot([](int x, int) { return x < 40 ? 1 : 1.12; }, options).count(kOccluding), kHeight);
}

TEST(EdgeDetector, TheCornerOfARoomIsOfHighCurvature) {
  // Two walls at 45 degrees to the view, with the edge between columns 39 and 40 nearest or farthest.
  for (const double sign : {1.0, -1.0}) {
    const auto shot = shoot([&](int x, int) { return 1 / (0.6 + sign * 0.6 * std::abs(x - 39.5) / 100); });
    EXPECT_GE(shot.count(kHighCurvature), kHeight);
    EXPECT_EQ(shot.count(kDiscontinuities), 0);
    for (int y = 0; y < kHeight; ++y) {
      for (const int x : shot.columns(y, kHighCurvature)) EXPECT_NEAR(x, 39.5, 1.6) << y;
    }
  }
}

TEST(EdgeDetector, ADepthDiscontinuityIsOfNoHighCurvature) {
  const auto shot = shoot([](int x, int) { return x < 40 ? 1 : 1 / (0.5 + 0.5 * (x - 39.5) / 100); });
  EXPECT_EQ(shot.count(kHighCurvature), 0);
  EXPECT_EQ(shot.count(kOccluding), kHeight);
}

TEST(EdgeDetector, KindsThatAreNotWantedAreNotThere) {
  EdgeOptions options;
  options.jumps = options.high_curvature = false;
  EXPECT_EQ(shoot([](int x, int) { return x < 40 ? 1 : 1.5; }, options).count(~0U), 0);
  EXPECT_EQ(shoot([&](int x, int) { return 1 / (0.6 + 0.6 * std::abs(x - 39.5) / 100); }, options).count(~0U), 0);
}

TEST(EdgeDetector, ImagesOfNothingOrNextToNothingHaveNoEdges) {
  EXPECT_EQ(shoot([](int, int) { return kNan; }).count(~0U), 0);
  EXPECT_EQ(shoot([](int, int) { return 0; }).count(~0U), 0);
  const std::vector<std::uint16_t> saturated(64, 65535);
  EXPECT_EQ(Shot({{}, EdgeDetector({}).detect(camera::DepthImage(saturated.data(), 0.001, 8, 8, kCamera))}).count(~0U),
            0);
  for (const int width : {0, 1, 2, 7, 17}) {
    for (const int height : {0, 1, 2, 9}) {
      const auto shot = shoot([](int, int) { return 1; }, {}, width, height);
      EXPECT_EQ(shot.edges.labels.size(), static_cast<std::size_t>(width * height));
      EXPECT_EQ(shot.count(~0U), 0);
    }
  }
}

TEST(EdgeDetector, SmallImagesHaveTheirDepthDiscontinuities) {
  for (int width = 2; width < 20; ++width) {
    const auto shot = shoot([&](int x, int) { return x + 1 < width ? 2 : 1; }, {}, width, 3);
    EXPECT_EQ(shot.columns(1, kOccluding), Columns{width - 1});
    EXPECT_EQ(shot.columns(1, kOccluded), Columns{width - 2});
  }
}

TEST(EdgeDetector, ThresholdsThatContradictEachOtherAreRefused) {
  EdgeOptions options;
  options.min_depth = 5;
  options.max_depth = 5;
  EXPECT_THROW(EdgeDetector{options}, base::Error);
  options = {};
  options.rgb_low = 101;
  EXPECT_THROW(EdgeDetector{options}, base::Error);
}

TEST(EdgeDetector, PointsAreThoseOfTheirPixels) {
  const auto shot = shoot([](int x, int) { return x < 40 ? 1 : 2; });
  const camera::DepthImage image(shot.depth.data(), kWidth, kHeight, kCamera);
  const auto near = edgePoints(shot.edges, image, kOccluding), far = edgePoints(shot.edges, image, kOccluded);
  ASSERT_EQ(near.size(), static_cast<std::size_t>(kHeight));
  ASSERT_EQ(far.size(), static_cast<std::size_t>(kHeight));
  EXPECT_LT((near[0] - Eigen::Vector3f(-0.005F, -0.315F, 1)).norm(), 1e-6F);
  EXPECT_LT((far[1] - Eigen::Vector3f(0.01F, -0.61F, 2)).norm(), 1e-6F);
  EXPECT_EQ(edgePoints(shot.edges, image, kDiscontinuities).size(), 2U * kHeight);
  const camera::DepthImage other(shot.depth.data(), kWidth, kHeight - 1, kCamera);
  EXPECT_THROW(edgePoints(shot.edges, other, kDiscontinuities), base::Error);
}

TEST(EdgeDetector, KindsHaveNames) {
  std::set<std::string> names;
  for (const EdgeKind kind : kEdgeKinds) names.insert(nameOf(kind));
  EXPECT_EQ(names, (std::set<std::string>{"boundary", "occluding", "occluded", "high_curvature", "rgb"}));
}

// Share of the pixels of a kind in `labels` that have a pixel of that kind in `others` within `reach`.
double partNear(const std::vector<std::uint8_t>& labels, unsigned kind, const std::vector<std::uint8_t>& others,
                int width, int height, int reach) {
  double near = 0, all = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if ((labels[static_cast<std::size_t>(y * width + x)] & kind) == 0) continue;
      bool found = false;
      for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); ++u) {
          found |= (others[static_cast<std::size_t>(v * width + u)] & kind) != 0;
        }
      }
      near += found;
      ++all;
    }
  }
  return all > 0 ? near / all : 0;
}

// 1/z of a face's plane at a pixel.
double inverseDepth(const rooms::Scene& scene, std::uint16_t face, std::size_t pixel) {
  const rooms::Face& f = scene.faces[face - 1U];
  const Eigen::Vector3d normal = f.half_a.cross(f.half_b);
  const auto width = static_cast<std::size_t>(scene.width);
  const Eigen::Vector3d ray((static_cast<double>(pixel % width) - scene.camera.cx) / scene.camera.fx,
                            (static_cast<double>(pixel / width) - scene.camera.cy) / scene.camera.fy, 1);
  return normal.dot(ray) / normal.dot(f.middle);
}

// Labels the nearer of two neighbours on different faces where each face, continued to the other pixel, is off by at
// least `least` in 1/z [1/m], in which the noise is the same everywhere.
std::vector<std::uint8_t> occlusionsOf(const rooms::Scene& scene, const rooms::View& view, double least) {
  std::vector<std::uint8_t> labels(view.depth.size(), 0);
  const auto width = static_cast<std::size_t>(scene.width);
  for (std::size_t a = 0; a + width < labels.size(); ++a) {
    for (const std::size_t b : {a + 1, a + width}) {
      if (view.face[a] == view.face[b]) continue;
      const double one = 1 / view.depth[b] - inverseDepth(scene, view.face[a], b);
      const double other = inverseDepth(scene, view.face[b], a) - 1 / view.depth[a];
      if (std::min(std::abs(one), std::abs(other)) < least || one * other < 0) continue;
      labels[one < 0 ? a : b] |= kOccluding;
    }
  }
  return labels;
}

TEST(EdgeQuality, OccludingEdgesOfNoisyRoomsAreFound) {
  double precision = 0, recall = 0;
  constexpr int kRooms = 8;
  for (std::uint64_t seed = 0; seed < kRooms; ++seed) {
    testing::Dice dice(seed);
    const auto scene = rooms::randomRoom(dice);
    const auto view = rooms::render(scene);
    const auto depth = rooms::withNoise(view, scene.width, scene.height, camera::DepthNoise(), dice);
    const auto any = occlusionsOf(scene, view, 0.003), large = occlusionsOf(scene, view, 0.02);
    const auto found =
        EdgeDetector({}).detect(camera::DepthImage(depth.data(), scene.width, scene.height, scene.camera)).labels;
    precision += partNear(found, kOccluding, any, scene.width, scene.height, 2) / kRooms;
    recall += partNear(large, kOccluding, found, scene.width, scene.height, 2) / kRooms;
  }
  EXPECT_GT(precision, 0.9);
  EXPECT_GT(recall, 0.95);
}

TEST(EdgeDetector, SeveralThreadsAtOnceGetWhatOneGets) {
  const EdgeDetector detector({});
  testing::Dice dice(5);
  const auto scene = rooms::randomRoom(dice);
  const auto depth = rooms::withNoise(rooms::render(scene), scene.width, scene.height, camera::DepthNoise(), dice);
  const camera::DepthImage image(depth.data(), scene.width, scene.height, scene.camera);
  const auto alone = detector.detect(image).labels;
  std::vector<std::vector<std::uint8_t>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = detector.detect(image).labels; });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace omnimapper::perception::edge_detector_test

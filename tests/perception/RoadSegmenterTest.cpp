#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/RoadComparator.h>
#include <omnimapper/perception/RoadExtractor.h>
#include <omnimapper/perception/RoadSegmenter.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "../camera/RangeScans.h"

namespace omnimapper::perception::road_segmenter_test {
namespace {

constexpr int kWidth = 320, kHeight = 240;
constexpr double kCameraHeight = 1.2;  // [m]
const camera::Pinhole kCamera{200, 200, 159.5, 41.5};
// A camera that looks level: up is against y.
const geometry::Plane3 kExpected{-Eigen::Vector3d::UnitY(), kCameraHeight};

/// A world with heights [m] above the expected ground as a function of depth, and an object at a depth in some columns.
struct World {
  std::function<double(double)> height = [](double) { return 0.; };
  double object = std::numeric_limits<double>::infinity();  ///< [m] depth
  int object_begin = 0, object_end = 0;                     ///< columns
  double object_height = 0;                                 ///< [m]
};

constexpr double kFarthest = 15;

// The first depth at which a ray meets the ground, in steps of 5 mm; 0 for the sky.
double groundDepth(const World& world, double down) {
  for (double z = 0.5; z < kFarthest; z += 0.005) {
    if (down * z >= kCameraHeight - world.height(z)) return z;
  }
  return 0;
}

struct View {
  std::vector<float> depth;
  std::vector<bool> ground;
};

View look(const World& world, double noise = 0, std::uint64_t seed = 1) {
  View view;
  testing::Dice dice(seed);
  for (int y = 0; y < kHeight; ++y) {
    const double down = (y - kCamera.cy) / kCamera.fy, ground = groundDepth(world, down);
    for (int x = 0; x < kWidth; ++x) {
      const double foot = world.height(world.object) - kCameraHeight;  // of the object, above the camera
      const bool object = x >= world.object_begin && x < world.object_end && (ground == 0 || ground > world.object) &&
                          -down * world.object <= foot + world.object_height;
      const double z = object ? world.object : ground;
      view.ground.push_back(!object && ground > 0);
      view.depth.push_back(z > 0 ? static_cast<float>(1 / (1 / z + dice.normal(noise))) : 0.F);
    }
  }
  return view;
}

RoadOptions noiseless() {
  RoadOptions options;
  options.noise_at_1m = 0.001;
  options.window_radius = 3;
  return options;
}

RoadSegmentation segment(const View& view, const RoadOptions& options = noiseless()) {
  return RoadSegmenter(options).segment(camera::DepthImage(view.depth.data(), kWidth, kHeight, kCamera), kExpected);
}

struct Shares {
  double found = 0, accepted = 0;
};

Shares sharesOf(const View& view, const RoadSegmentation& segmentation) {
  double ground = 0, found = 0, others = 0, accepted = 0;
  for (std::size_t i = 0; i < view.depth.size(); ++i) {
    if (!(view.depth[i] > 0)) continue;
    const bool labelled = segmentation.ground.labels[i] != 0;
    (view.ground[i] ? ground : others) += 1;
    (view.ground[i] ? found : accepted) += labelled;
  }
  return {found / std::max(1., ground), accepted / std::max(1., others)};
}

TEST(RoadSegmenter, FlatGroundIsFoundWithItsPlane) {
  const auto view = look({});
  const auto found = segment(view);
  EXPECT_GT(sharesOf(view, found).found, 0.97);
  ASSERT_EQ(found.ground.planes.size(), 1U);
  EXPECT_LT((found.ground.planes[0].plane_in_sensor.normal - kExpected.normal).norm(), 0.01);
  EXPECT_NEAR(found.ground.planes[0].plane_in_sensor.distance, kCameraHeight, 0.02);
}

TEST(RoadSegmenter, TheRmsIsThatFromTheGroundNotFromWhatIsExpected) {
  World world;
  world.height = [](double) { return 0.1; };
  const auto found = segment(look(world));
  ASSERT_EQ(found.ground.planes.size(), 1U);
  EXPECT_NEAR(found.ground.planes[0].plane_in_sensor.distance, kCameraHeight - 0.1, 0.02);
  EXPECT_LT(found.ground.planes[0].rms, 0.005);
}

TEST(RoadSegmenter, GroundThatRisesAheadIsFoundAndARampThatIsTooSteepIsNot) {
  World world;
  world.height = [](double z) { return z < 4 ? 0 : 0.08 * (z - 4); };
  const auto hill = look(world);
  EXPECT_GT(sharesOf(hill, segment(hill)).found, 0.95);
  world.height = [](double z) { return z < 4 ? 0 : 0.8 * (z - 4); };
  const auto wall = look(world);
  const auto found = segment(wall);
  for (std::size_t i = 0; i < wall.depth.size(); ++i) {
    if (wall.depth[i] > 4.6F) {
      EXPECT_EQ(found.ground.labels[i], 0) << i;
    }
  }
}

TEST(RoadSegmenter, WhatStandsOnItIsNotGround) {
  World world;
  world.object = 4;
  world.object_begin = 120;
  world.object_end = 200;
  world.object_height = 0.8;
  const auto view = look(world);
  const auto shares = sharesOf(view, segment(view));
  EXPECT_GT(shares.found, 0.95);
  EXPECT_LT(shares.accepted, 0.05);
}

TEST(RoadSegmenter, WhatIsFarFromTheExpectedGroundIsNotGround) {
  World world;
  world.height = [](double) { return 0.6; };
  auto options = noiseless();
  options.max_slope = 0;
  EXPECT_TRUE(segment(look(world), options).ground.planes.empty()) << "a table";
  options.max_off = 0.7;
  const auto view = look(world);
  const auto found = segment(view, options);
  EXPECT_GT(sharesOf(view, found).found, 0.9);
  ASSERT_FALSE(found.ground.planes.empty());
  EXPECT_NEAR(found.ground.planes[0].plane_in_sensor.distance, kCameraHeight - 0.6, 0.02);
}

TEST(RoadSegmenter, NoisyGroundWithAnObjectOnASlope) {
  World world;
  world.height = [](double z) { return z < 3 ? 0 : 0.05 * (z - 3); };
  world.object = 4;
  world.object_begin = 120;
  world.object_end = 200;
  world.object_height = 1.5;
  double found = 0, accepted = 0;
  constexpr int kViews = 5;
  for (std::uint64_t seed = 0; seed < kViews; ++seed) {
    const auto view = look(world, RoadOptions().noise_at_1m, seed);
    const auto segmentation = segment(view, {});
    const auto shares = sharesOf(view, segmentation);
    found += shares.found / kViews;
    accepted += shares.accepted / kViews;
    for (std::size_t i = 0; i < view.depth.size(); ++i) {
      EXPECT_LE(segmentation.sure[i], segmentation.ground.labels[i] != 0 ? 1 : 0);
    }
  }
  EXPECT_GT(found, 0.9);
  EXPECT_LT(accepted, 0.1) << "the foot of an object in an image as small as this";
}

// Share of ground in the rows [begin, end) of the image.
double shareOfRows(const RoadSegmentation& found, int begin, int end) {
  const auto at = [&](int row) { return found.ground.labels.begin() + static_cast<std::ptrdiff_t>(row) * kWidth; };
  return 1 - static_cast<double>(std::count(at(begin), at(end), 0)) / ((end - begin) * kWidth);
}

// A kerb straight ahead, from one side of the image to the other. Its side is in rows 102 to 110, all of it at 3.5 m.
TEST(RoadSegmenter, TheSideOfAKerbIsNotGroundAndWhatIsBeforeAndBehindItIs) {
  World world;
  world.height = [](double z) { return z < 3.5 ? 0 : 0.15; };
  RoadOptions without_steps;
  without_steps.step_sigmas = 100;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const auto view = look(world, RoadOptions().noise_at_1m, seed);
    const auto found = segment(view, {});
    EXPECT_LT(shareOfRows(found, 102, 110), 0.15) << "but for its upper edge";
    EXPECT_GT(shareOfRows(found, 120, 200), 0.95);
    EXPECT_GT(shareOfRows(found, 60, 100), 0.9);
    EXPECT_GT(shareOfRows(segment(view, without_steps), 102, 110), 0.3);
  }
}

TEST(RoadSegmenter, NoiseAloneMakesNoSteps) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const auto found = segment(look({}, RoadOptions().noise_at_1m, seed), {});
    EXPECT_GT(shareOfRows(found, 60, 200), 0.95);
  }
}

TEST(RoadSegmenter, ImagesOfNothingHaveNoGround) {
  const std::vector<float> nothing(kWidth * kHeight, 0.F);
  EXPECT_TRUE(segment({nothing, {}}).ground.planes.empty());
  for (const int width : {0, 1, 17}) {
    for (const int height : {0, 1, 5}) {
      const std::vector<float> ones(static_cast<std::size_t>(width * height), 1.F);
      const auto found = RoadSegmenter({}).segment(camera::DepthImage(ones.data(), width, height, kCamera), kExpected);
      EXPECT_TRUE(found.ground.planes.empty());
      EXPECT_EQ(found.sure.size(), ones.size());
    }
  }
}

TEST(RoadSegmenter, ContradictoryDepthsAreRefused) {
  RoadOptions options;
  options.min_depth = options.max_depth;
  EXPECT_THROW(RoadSegmenter{options}, base::Error);
}

TEST(RoadSegmenter, SeveralThreadsAtOnceGetWhatOneGets) {
  const auto view = look({}, 0.004);
  const auto alone = segment(view, {}).ground.labels;
  std::vector<std::vector<std::uint16_t>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = segment(view, {}).ground.labels; });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

TEST(RoadComparator, ChecksSlopeHeightAndSmoothness) {
  // One pixel each: level ground, ground aslant by 30 degrees, level ground 1 m up, and nothing.
  OrganizedPoints points{4, 1, {0, 0, 0, 0}, {1, 1, 0, 1}, {5, 5, 5, 5}};
  NormalImage normals;
  normals.width = 4;
  normals.height = 1;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  normals.values.reset(new float[12]{0, 0, 0, nan, -1, -0.866F, -1, nan, 0, -0.5F, 0, nan});
  const RoadComparator road{points, normals, -Eigen::Vector3f::UnitY(), 1.F};
  EXPECT_TRUE(road.valid(0));
  EXPECT_FALSE(road.valid(1));
  EXPECT_FALSE(road.valid(2));
  EXPECT_FALSE(road.valid(3));
  EXPECT_TRUE(road.similar(0, 2));
  EXPECT_FALSE(road.similar(0, 1));
}

TEST(RoadExtractor, TheExpectedGroundIsThatOfTheBaseSeenFromTheSensor) {
  auto scan = camera::scans::rangeScan([](int, int) { return 1.; });
  // 1.4 m up, looking down by 30 degrees: the ground's normal is up, tilted to the camera.
  scan.sensorPose = mrpt::poses::CPose3D(0.2, 0.1, 1.4, 0.3, M_PI / 6, 0);
  const auto ground = expectedGround(scan, 0.1);
  EXPECT_NEAR(ground.distance, 1.3, 1e-9);
  EXPECT_LT((ground.normal - Eigen::Vector3d(0, -std::cos(M_PI / 6), -std::sin(M_PI / 6))).norm(), 1e-9);
}

}  // namespace
}  // namespace omnimapper::perception::road_segmenter_test

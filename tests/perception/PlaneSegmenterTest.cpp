#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <cmath>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "DepthRooms.h"

namespace omnimapper::perception::plane_segmenter_test {
namespace {

using geometry::Plane3;
using rooms::Face;
using rooms::Scene;

/// Rows of a depth image in metres, from a function of the pixel.
std::vector<float> depths(int width, int height, const std::function<double(int, int)>& depth) {
  std::vector<float> image;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.push_back(static_cast<float>(depth(x, y)));
  }
  return image;
}

const camera::Pinhole kCamera{100, 100, 79.5, 59.5};
constexpr int kWidth = 160, kHeight = 120;

PlaneSegmentation segment(const std::vector<float>& image, int width = kWidth, int height = kHeight,
                          const PlaneOptions& options = {}) {
  return PlaneSegmenter(options).segment(camera::DepthImage(image.data(), width, height, kCamera));
}

double depthOf(const Plane3& plane, int x, int y) {
  const Eigen::Vector3d ray((x - kCamera.cx) / kCamera.fx, (y - kCamera.cy) / kCamera.fy, 1);
  return -plane.distance / plane.normal.dot(ray);
}

double areaOf(const Contour& contour) {
  double twice = 0;
  for (std::size_t i = 0; i < contour.corners.size(); ++i) {
    const PixelCorner &a = contour.corners[i], &b = contour.corners[(i + 1) % contour.corners.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return -twice / 2;  // y is down
}

TEST(PlaneSegmenter, AWallStraightAheadIsOnePlaneAsWorkedByHand) {
  const auto found = segment(depths(kWidth, kHeight, [](int, int) { return 2; }));
  ASSERT_EQ(found.planes.size(), 1U);
  const PlaneRegion& wall = found.planes[0];
  EXPECT_LT((wall.plane_in_sensor.normal - Eigen::Vector3d(0, 0, -1)).norm(), 1e-5);
  EXPECT_NEAR(wall.plane_in_sensor.distance, 2, 1e-5);
  EXPECT_LT((wall.centroid - Eigen::Vector3d(0, 0, 2)).norm(), 1e-5);
  EXPECT_EQ(wall.inliers, kWidth * kHeight);
  EXPECT_LT(wall.rms, 1e-5);
  EXPECT_EQ(wall.outline.corners, (std::vector<PixelCorner>{{0, 120}, {160, 120}, {160, 0}, {0, 0}}));
  const auto& corners = wall.outline.polygon_in_sensor.vertices;
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_LT((corners[1] - Eigen::Vector3d(1.6, 1.2, 2)).norm(), 1e-4);
  EXPECT_LT((corners[3] - Eigen::Vector3d(-1.6, -1.2, 2)).norm(), 1e-4);
  EXPECT_LT((areaVector(wall.outline.polygon_in_sensor) - 3.2 * 2.4 * wall.plane_in_sensor.normal).norm(), 1e-4);
  EXPECT_TRUE(wall.holes.empty());
  for (const std::uint16_t label : found.labels) EXPECT_EQ(label, 1);
}

TEST(PlaneSegmenter, TheVarianceOfAWallStraightAheadIsAsWorkedByHand) {
  // 1/z = a x/f + b y/f + c. The image is symmetric about its middle, so the errors of a, b and c are independent. The
  // rotation about the second axis is d times the error of a, that of the distance d^2 times the error of c.
  PlaneOptions options;
  options.distortion_at_1m = options.scale_sigma = 0;
  const auto found = segment(depths(kWidth, kHeight, [](int, int) { return 2; }), kWidth, kHeight, options);
  ASSERT_EQ(found.planes.size(), 1U);
  const double n = kWidth * kHeight, variance = camera::DepthNoise().meanVariance();
  const double of_a = variance / (n * (kWidth * kWidth - 1) / 12.0) * 1e4;
  const double of_b = variance / (n * (kHeight * kHeight - 1) / 12.0) * 1e4;
  const Eigen::Vector3d expected(4 * of_a, 4 * of_b, 16 * variance / n);
  const Eigen::Matrix3d& covariance = found.planes[0].covariance;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(covariance(i, i), expected[i], 1e-3 * expected[i]) << i;
  EXPECT_LT(std::abs(covariance(0, 1)), 1e-4 * expected[0]);
  EXPECT_LT(std::abs(covariance(0, 2)), 1e-4 * std::sqrt(expected[0] * expected[2]));
}

TEST(PlaneSegmenter, AnErrorOfScaleIsOneOfTheDistanceAlone) {
  PlaneOptions options;
  options.scale_sigma = 0;
  const Plane3 wall = {Eigen::Vector3d(0.3, -0.2, -0.9).normalized(), 1.8};
  const auto image = depths(kWidth, kHeight, [&](int x, int y) { return depthOf(wall, x, y); });
  const auto exact = segment(image, kWidth, kHeight, options);
  options.scale_sigma = 0.03;
  const auto scaled = segment(image, kWidth, kHeight, options);
  ASSERT_EQ(scaled.planes.size(), 1U);
  Eigen::Matrix3d added = scaled.planes[0].covariance - exact.planes.at(0).covariance;
  const double of_distance = 0.03 * scaled.planes[0].plane_in_sensor.distance;
  EXPECT_NEAR(added(2, 2), of_distance * of_distance, 1e-9);
  added(2, 2) = 0;
  EXPECT_LT(added.norm(), 1e-12);
}

TEST(PlaneSegmenter, ATiltedPlaneIsExact) {
  const Plane3 floor = {Eigen::Vector3d(0.1, -0.8, -0.5).normalized(), 1.3};
  const auto found = segment(depths(kWidth, kHeight, [&](int x, int y) { return depthOf(floor, x, y); }));
  ASSERT_EQ(found.planes.size(), 1U);
  EXPECT_LT((found.planes[0].plane_in_sensor.normal - floor.normal).norm(), 1e-5);
  EXPECT_NEAR(found.planes[0].plane_in_sensor.distance, floor.distance, 1e-5);
}

TEST(PlaneSegmenter, DepthsIn16BitsMeanTheSameAsInMetres) {
  std::vector<std::uint16_t> units;
  for (int i = 0; i < kWidth * kHeight; ++i) units.push_back(static_cast<std::uint16_t>(7000 + i % kWidth * 10));
  std::vector<float> metres;
  for (const std::uint16_t u : units) metres.push_back(static_cast<float>(u) / 5000.F);
  const auto a = PlaneSegmenter({}).segment(camera::DepthImage(units.data(), 1 / 5000., kWidth, kHeight, kCamera));
  const auto b = segment(metres);
  ASSERT_EQ(a.planes.size(), b.planes.size());
  EXPECT_EQ(a.labels, b.labels);
  for (std::size_t i = 0; i < a.planes.size(); ++i) {
    EXPECT_NEAR(a.planes[i].plane_in_sensor.distance, b.planes[i].plane_in_sensor.distance, 1e-4);
  }
}

TEST(PlaneSegmenter, TwoWallsMeetInTheLineTheyCrossIn) {
  // Both walls of the corner are at 45 deg to the view, and its edge is in the middle column.
  const auto found = segment(depths(kWidth, kHeight, [](int x, int) { return 3 / (1 + std::abs(x - 79.5) / 100); }));
  ASSERT_EQ(found.planes.size(), 2U);
  const std::uint16_t left = found.labels[0];
  for (std::size_t i = 0; i < found.labels.size(); ++i) {
    EXPECT_EQ(found.labels[i], i % kWidth < 80 ? left : 3 - left) << i % kWidth;
  }
}

TEST(PlaneSegmenter, AStepOfAFewCentimetresSeparatesTwoPlanes) {
  const auto found = segment(depths(kWidth, kHeight, [](int x, int) { return x < 70 ? 1 : 1.03; }));
  ASSERT_EQ(found.planes.size(), 2U);
  EXPECT_NEAR(found.planes[0].plane_in_sensor.distance, 1.03, 1e-4);
  EXPECT_NEAR(found.planes[1].plane_in_sensor.distance, 1, 1e-4);
  EXPECT_EQ(found.planes[0].inliers, 90 * kHeight);
}

// Systematic distortion may move each half by 4 mm at 1 m, away from the other.
TEST(PlaneSegmenter, HalvesOfAWallThatTheSensorDistortsApartAreOnePlane) {
  const auto planesWithAStepOf = [](double metres) {
    const auto image = depths(kWidth, kHeight, [&](int x, int) { return x < kWidth / 2 ? 1 : 1 + metres; });
    return segment(image).planes.size();
  };
  EXPECT_EQ(planesWithAStepOf(0.006), 1U);
  EXPECT_EQ(planesWithAStepOf(0.01), 2U);
}

TEST(PlaneSegmenter, AHoleIsOutlinedTheOtherWayRound) {
  const auto found =
      segment(depths(kWidth, kHeight, [](int x, int y) { return x >= 50 && x < 60 && y >= 30 && y < 37 ? 0 : 1.5; }));
  ASSERT_EQ(found.planes.size(), 1U);
  const PlaneRegion& wall = found.planes[0];
  EXPECT_EQ(wall.inliers, kWidth * kHeight - 70);
  EXPECT_EQ(areaOf(wall.outline), kWidth * kHeight);
  ASSERT_EQ(wall.holes.size(), 1U);
  EXPECT_EQ(areaOf(wall.holes[0]), -70);
  EXPECT_EQ(wall.holes[0].corners.size(), 4U);
  for (const auto& point : wall.holes[0].polygon_in_sensor.vertices) {
    EXPECT_NEAR(signedDistance(wall.plane_in_sensor, point), 0, 1e-9);
  }
}

TEST(PlaneSegmenter, APlaneNearlyEdgeOnIsFound) {
  // A floor 10 cm below the camera, which far away is seen at an angle of a degree or two.
  const auto found = segment(depths(kWidth, kHeight, [](int, int y) { return y > 59 ? 10 / (y - 59.5) : 0; }));
  ASSERT_EQ(found.planes.size(), 1U);
  EXPECT_LT((found.planes[0].plane_in_sensor.normal - Eigen::Vector3d(0, -1, 0)).norm(), 1e-4);
  EXPECT_NEAR(found.planes[0].plane_in_sensor.distance, 0.1, 1e-5);
}

TEST(PlaneSegmenter, ABallIsNoPlane) {
  // A ball with a radius of 0.5 m, whose middle is 1.2 m ahead.
  const auto found = segment(depths(kWidth, kHeight, [](int x, int y) {
    const Eigen::Vector3d ray = Eigen::Vector3d((x - 79.5) / 100, (y - 59.5) / 100, 1).normalized();
    const double along = 1.2 * ray.z(), left = along * along - 1.2 * 1.2 + 0.25;
    return left < 0 ? 0 : (along - std::sqrt(left)) * ray.z();
  }));
  int pixels = 0;
  for (const auto& plane : found.planes) pixels += plane.inliers;
  EXPECT_LT(pixels, 2000);
}

TEST(PlaneSegmenter, ImagesWithoutAMeasurementGiveNone) {
  for (const double depth : {0., std::nan(""), -1., double{std::numeric_limits<float>::infinity()}, 1e-30, 1e30}) {
    const auto found = segment(depths(kWidth, kHeight, [&](int, int) { return depth; }));
    EXPECT_TRUE(found.planes.empty()) << depth;
    EXPECT_EQ(found.labels, std::vector<std::uint16_t>(kWidth * kHeight, 0)) << depth;
  }
  const std::vector<std::uint16_t> saturated(kWidth * kHeight, 65535);
  const camera::DepthImage image(saturated.data(), 1e-4, kWidth, kHeight, kCamera);
  EXPECT_TRUE(PlaneSegmenter({}).segment(image).planes.empty());
}

TEST(PlaneSegmenter, SmallAndOddImagesAreWelcome) {
  EXPECT_TRUE(segment({}, 0, 0).planes.empty());
  EXPECT_TRUE(segment({}, 0, 7).labels.empty());
  EXPECT_TRUE(segment({1.F}, 1, 1).planes.empty());
  EXPECT_EQ(segment({1.F}, 1, 1).labels.size(), 1U);
  for (const int width : {15, 47, 61, 101}) {
    const auto found = segment(depths(width, 53, [](int, int) { return 1; }), width, 53);
    EXPECT_EQ(found.labels.size(), static_cast<std::size_t>(width * 53));
    ASSERT_EQ(found.planes.size(), width < 32 ? 0U : 1U) << width;
    for (const auto& plane : found.planes) EXPECT_EQ(plane.inliers, width * 53) << width;
  }
}

TEST(PlaneSegmenter, WhatIsNoImageIsRefused) {
  const std::vector<float> one{1.F};
  EXPECT_THROW(camera::DepthImage(one.data(), -1, 1, kCamera), base::Error);
  EXPECT_THROW(camera::DepthImage(one.data(), 100000, 1, kCamera), base::Error);
  EXPECT_THROW(camera::DepthImage(static_cast<const float*>(nullptr), 1, 1, kCamera), base::Error);
  EXPECT_THROW(camera::DepthImage(one.data(), 1, 1, camera::Pinhole{0, 1, 0, 0}), base::Error);
  EXPECT_THROW(camera::DepthImage(one.data(), 1, 1, camera::Pinhole{1, 1, std::nan(""), 0}), base::Error);
  const std::vector<std::uint16_t> unit{1};
  for (const double odd : {0., 0.5, 1e7, 1e300}) {
    EXPECT_THROW(camera::DepthImage(unit.data(), 1e-3, 1, 1, {odd, 100, 0, 0}), base::Error) << odd;
    EXPECT_THROW(camera::DepthImage(unit.data(), 1e-3, 1, 1, {100, -odd, 0, 0}), base::Error) << odd;
  }
  EXPECT_THROW(camera::DepthImage(unit.data(), 1e-3, 1, 1, {100, 100, 0, 1e7}), base::Error);
  EXPECT_THROW(camera::DepthImage(unit.data(), 0, 1, 1, kCamera), base::Error);
  PlaneOptions options;
  options.max_depth = options.min_depth;
  EXPECT_THROW(PlaneSegmenter{options}, base::Error);
}

TEST(PlaneSegmenter, RandomBytesGiveASoundResult) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    testing::Dice dice(seed);
    const int width = static_cast<int>(dice.uniform(1, 130)), height = static_cast<int>(dice.uniform(1, 90));
    std::vector<std::uint16_t> units(static_cast<std::size_t>(width * height));
    const double spread = dice.uniform(0, 1) < 0.5 ? 65535 : 300;
    for (auto& u : units) u = static_cast<std::uint16_t>(dice.uniform(0, spread) + (spread < 1000 ? 1000 : 0));
    PlaneOptions options;
    options.min_pixels = 16;
    const auto found = PlaneSegmenter(options).segment(camera::DepthImage(units.data(), 1e-3, width, height, kCamera));
    std::vector<int> pixels(found.planes.size() + 1, 0);
    for (const std::uint16_t label : found.labels) ++pixels.at(label);
    for (std::size_t i = 0; i < found.planes.size(); ++i) {
      EXPECT_EQ(found.planes[i].inliers, pixels[i + 1]);
      EXPECT_GE(areaOf(found.planes[i].outline), pixels[i + 1]);
      EXPECT_TRUE(found.planes[i].covariance.allFinite());
    }
  }
}

TEST(PlaneSegmenter, OutlinesEncloseThePixelsOfTheirPlaneAndNothingElse) {
  testing::Dice dice(3);
  const Scene scene = rooms::randomRoom(dice);
  const auto depth = rooms::withNoise(rooms::render(scene), scene.width, scene.height, camera::DepthNoise(), dice);
  PlaneOptions options;
  options.min_hole_pixels = 1;
  const auto found = PlaneSegmenter(options).segment(camera::DepthImage(depth.data(), 640, 480, scene.camera));
  ASSERT_GT(found.planes.size(), 3U);
  for (const PlaneRegion& plane : found.planes) {
    double area = areaOf(plane.outline);
    for (const Contour& hole : plane.holes) area += areaOf(hole);
    EXPECT_EQ(area, plane.inliers);
    EXPECT_GT(plane.plane_in_sensor.distance, 0);
    EXPECT_NEAR(plane.plane_in_sensor.normal.norm(), 1, 1e-12);
    EXPECT_NEAR(signedDistance(plane.plane_in_sensor, plane.centroid), 0, 0.02);
  }
}

TEST(PlaneSegmenter, ThreadsAndRepetitionChangeNoBit) {
  testing::Dice dice(5);
  const Scene scene = rooms::randomRoom(dice);
  const auto depth = rooms::withNoise(rooms::render(scene), scene.width, scene.height, camera::DepthNoise(), dice);
  const PlaneSegmenter segmenter({});
  const camera::DepthImage image(depth.data(), 640, 480, scene.camera);
  const auto expected = segmenter.segment(image);
  std::vector<PlaneSegmentation> found(4);
  std::vector<std::thread> threads;
  for (auto& result : found) threads.emplace_back([&] { result = segmenter.segment(image); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : found) {
    EXPECT_EQ(result.labels, expected.labels);
    ASSERT_EQ(result.planes.size(), expected.planes.size());
    for (std::size_t i = 0; i < result.planes.size(); ++i) {
      EXPECT_EQ(result.planes[i].plane_in_sensor.normal, expected.planes[i].plane_in_sensor.normal);
      EXPECT_EQ(result.planes[i].covariance, expected.planes[i].covariance);
      EXPECT_EQ(result.planes[i].outline.corners, expected.planes[i].outline.corners);
    }
  }
}

}  // namespace
}  // namespace omnimapper::perception::plane_segmenter_test

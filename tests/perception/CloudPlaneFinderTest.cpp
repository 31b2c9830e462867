#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/perception/CloudPlaneFinder.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <thread>

#include "PlaneAgreement.h"

namespace omnimapper::perception::cloud_plane_finder_test {
namespace {

using Cloud = std::vector<Eigen::Vector3f>;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Adds a point every 2 cm on a rectangle from (x, y), at height z; the sensor is at the origin.
void addTable(double x, double y, double length, double width, double z, Cloud& cloud) {
  for (int i = 0; i <= std::lround(length / 0.02); ++i) {
    for (int k = 0; k <= std::lround(width / 0.02); ++k)
      cloud.push_back(Eigen::Vector3d(x + 0.02 * i, y + 0.02 * k, z).cast<float>());
  }
}

CloudPlaneOptions everyPoint() {
  CloudPlaneOptions options;
  options.voxel = 0;
  return options;
}

TEST(CloudPlaneFinder, ATableBelowAsWorkedByHand) {
  Cloud cloud;
  addTable(1, -0.5, 1, 0.6, -0.5, cloud);
  const auto found = CloudPlaneFinder(everyPoint()).find(cloud);
  ASSERT_EQ(found.planes.size(), 1U);
  const CloudPlane& table = found.planes[0];
  EXPECT_LT((table.plane_in_sensor.normal - Eigen::Vector3d(0, 0, 1)).norm(), 1e-5) << "towards the sensor";
  EXPECT_NEAR(table.plane_in_sensor.distance, 0.5, 1e-5);
  EXPECT_LT((table.centroid - Eigen::Vector3d(1.5, -0.2, -0.5)).norm(), 1e-5);
  EXPECT_EQ(table.inliers, 51 * 31);
  EXPECT_LT(table.rms, 1e-5);
  EXPECT_NEAR(areaVector(table.outline).z(), 0.6, 0.02) << "counter-clockwise against the normal";
  EXPECT_TRUE(table.holes.empty());
  EXPECT_EQ(found.labels, std::vector<std::uint16_t>(cloud.size(), 1));
}

TEST(CloudPlaneFinder, PointsAreAveragedOverVoxels) {
  Cloud cloud;
  addTable(1.01, -0.49, 0.98, 0.58, -0.51, cloud);
  CloudPlaneOptions options;
  options.voxel = 0.1;
  options.max_gap = 0.15;
  options.min_points = 50;
  const auto found = CloudPlaneFinder(options).find(cloud);
  ASSERT_EQ(found.planes.size(), 1U);
  EXPECT_EQ(found.planes[0].inliers, 10 * 6);
  EXPECT_EQ(found.labels, std::vector<std::uint16_t>(cloud.size(), 1));
}

TEST(CloudPlaneFinder, SurfacesOfOnePlaneThatAreApartAreSeveral) {
  Cloud cloud;
  addTable(1, -1, 0.6, 0.6, -0.5, cloud);
  addTable(1, 0, 0.6, 0.5, -0.5, cloud);
  addTable(2, 0, 0.1, 0.1, -0.5, cloud);
  const auto found = CloudPlaneFinder(everyPoint()).find(cloud);
  ASSERT_EQ(found.planes.size(), 2U) << "the third is too small";
  EXPECT_EQ(found.planes[0].inliers, 31 * 31);
  EXPECT_EQ(found.planes[1].inliers, 31 * 26);
  EXPECT_EQ(found.labels.front(), 1);
  EXPECT_EQ(found.labels[31 * 31], 2);
  EXPECT_EQ(found.labels.back(), 0);
}

TEST(CloudPlaneFinder, AConcaveOutlineFollowsAnLAndHasHolesAConvexOneNot) {
  Cloud cloud;
  addTable(1, -1, 2, 0.6, -0.7, cloud);
  addTable(1, -0.4, 0.6, 1.4, -0.7, cloud);
  auto options = everyPoint();
  const auto concave = CloudPlaneFinder(options).find(cloud);
  ASSERT_EQ(concave.planes.size(), 1U);
  EXPECT_NEAR(area(concave.planes[0].outline), 2 * 0.6 + 0.6 * 1.4, 0.1);
  EXPECT_FALSE(contains(concave.planes[0].outline, {2.6, 0.5, -0.7}));
  options.outline = CloudPlaneOptions::Outline::convex;
  const auto convex = CloudPlaneFinder(options).find(cloud);
  ASSERT_EQ(convex.planes.size(), 1U);
  EXPECT_NEAR(area(convex.planes[0].outline), 2 * 2 - 0.5 * 1.4 * 1.4, 0.03);
  EXPECT_GT(areaVector(convex.planes[0].outline).z(), 0);
  Cloud ring;
  for (double x = 1; x < 3; x += 0.02) {
    for (double y = -1; y < 1; y += 0.02) {
      if (std::abs(x - 2) > 0.5 || std::abs(y) > 0.5) ring.push_back(Eigen::Vector3d(x, y, -0.7).cast<float>());
    }
  }
  const auto ringed = CloudPlaneFinder(everyPoint()).find(ring);
  ASSERT_EQ(ringed.planes.size(), 1U);
  ASSERT_EQ(ringed.planes[0].holes.size(), 1U);
  EXPECT_NEAR(area(ringed.planes[0].holes[0]), 1, 0.15);
  EXPECT_LT(areaVector(ringed.planes[0].holes[0]).z(), 0);
}

TEST(CloudPlaneFinder, WhatIsNoPointOrOutOfRangeIsLeftOut) {
  Cloud cloud;
  addTable(1, -0.5, 1, 1, -0.5, cloud);
  const std::size_t table = cloud.size();
  cloud.insert(cloud.end(), {{kNan, 0, 0}, {0, kNan, 1}, {std::numeric_limits<float>::infinity(), 0, 0}, {0, 0, 0}});
  addTable(200, 0, 1, 1, -0.5, cloud);
  const auto found = CloudPlaneFinder({}).find(cloud);
  ASSERT_EQ(found.planes.size(), 1U);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(found.labels[i], i < table ? 1 : 0) << i;
}

TEST(CloudPlaneFinder, CloudsWithoutSurfacesHaveNone) {
  EXPECT_TRUE(CloudPlaneFinder({}).find({}).planes.empty());
  EXPECT_EQ(CloudPlaneFinder({}).find({{1, 2, 3}}).labels, std::vector<std::uint16_t>{0});
  EXPECT_TRUE(CloudPlaneFinder(everyPoint()).find(Cloud(1000, {1, 1, 1})).planes.empty()) << "one place";
  Cloud line, dust;
  for (int i = 0; i < 1000; ++i) line.emplace_back(1 + 0.005F * static_cast<float>(i), 1, 1);
  EXPECT_TRUE(CloudPlaneFinder(everyPoint()).find(line).planes.empty());
  testing::Dice dice(3);
  for (int i = 0; i < 3000; ++i)
    dust.push_back(Eigen::Vector3d(dice.uniform(-5, 5), dice.uniform(-5, 5), dice.uniform(-5, 5)).cast<float>());
  EXPECT_TRUE(CloudPlaneFinder(everyPoint()).find(dust).planes.empty());
}

TEST(CloudPlaneFinder, APlaneThroughTheSensorIsNoneThatItSees) {
  Cloud turn;  // one turn of a laser, in a round room whose wall is not smooth
  for (int i = 0; i < 2000; ++i) {
    const double angle = 2 * M_PI * i / 2000, range = i % 2 == 0 ? 3 : 3.05;
    turn.push_back(Eigen::Vector3d(range * std::cos(angle), range * std::sin(angle), 0.02).cast<float>());
  }
  auto options = everyPoint();
  EXPECT_TRUE(CloudPlaneFinder(options).find(turn).planes.empty());
  options.min_incidence = 0;
  EXPECT_EQ(CloudPlaneFinder(options).find(turn).planes.size(), 1U);
}

TEST(CloudPlaneFinder, ALineOfPointsBesideASurfaceIsNoPlane) {
  Cloud cloud;
  addTable(1, -0.5, 1, 0.6, -0.5, cloud);
  const std::size_t table = cloud.size();
  addTable(1, 0.6, 5, 0, -0.5, cloud);  // one row of the same plane, farther from the rest than a gap
  auto options = everyPoint();
  options.min_points = 50;
  const auto found = CloudPlaneFinder(options).find(cloud);
  ASSERT_EQ(found.planes.size(), 1U);
  EXPECT_EQ(found.planes[0].inliers, static_cast<int>(table));
}

TEST(CloudPlaneFinder, ContradictoryRangesAreRefused) {
  CloudPlaneOptions options;
  options.max_range = options.min_range;
  EXPECT_THROW(CloudPlaneFinder{options}, base::Error);
}

Cloud noisyRoom(std::uint64_t seed) {
  testing::Dice dice(seed);
  const auto scene = rooms::randomRoom(dice);
  const auto depth = rooms::withNoise(rooms::render(scene), scene.width, scene.height, camera::DepthNoise(), dice);
  const auto points = backProject(camera::DepthImage(depth.data(), scene.width, scene.height, scene.camera));
  Cloud cloud;
  for (std::size_t i = 0; i < points.z.size(); ++i) cloud.emplace_back(points.x[i], points.y[i], points.z[i]);
  return cloud;
}

CloudPlaneOptions kinect() {
  CloudPlaneOptions options;
  options.noise_at_1m = 0.0023;
  return options;
}

TEST(CloudPlaneFinder, NoisyRoomsHaveTheirWallsAndTheSameSeedGivesTheSameBits) {
  double right = 0;
  constexpr int kRooms = 5;
  for (std::uint64_t seed = 0; seed < kRooms; ++seed) {
    testing::Dice dice(seed);
    const auto scene = rooms::randomRoom(dice);
    const auto found = CloudPlaneFinder(kinect()).find(noisyRoom(seed));
    right += rooms::compare(rooms::render(scene), found.labels, scene.width, scene.height, 1500).pixelsRight() / kRooms;
  }
  EXPECT_GT(right, 0.87);
  const Cloud cloud = noisyRoom(1);
  const CloudPlaneFinder finder(kinect());
  const auto alone = finder.find(cloud);
  std::vector<CloudPlanes> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = finder.find(cloud); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) {
    EXPECT_EQ(result.labels, alone.labels);
    ASSERT_EQ(result.planes.size(), alone.planes.size());
    for (std::size_t i = 0; i < alone.planes.size(); ++i) {
      EXPECT_EQ(result.planes[i].plane_in_sensor.normal, alone.planes[i].plane_in_sensor.normal);
      EXPECT_EQ(result.planes[i].outline.vertices, alone.planes[i].outline.vertices);
    }
  }
}

const geometry::Plane3 kTilted = geometry::Plane3::through({2, 0, -0.5}, Eigen::Vector3d(-0.3, 0.1, 1).normalized());
constexpr int kClouds = 200;

/// Chi-square of the one plane in each of 200 noisy clouds, with points every `spacing` [m]. One random error with the
/// standard deviation `bias` [m] moves all points of a cloud along their rays.
std::vector<double> chi2OfClouds(const CloudPlaneOptions& options, double spacing, double bias) {
  std::vector<double> chi2;
  testing::Dice dice(11);
  for (int n = 0; n < kClouds; ++n) {
    Cloud cloud;
    const double off = dice.normal(bias);
    for (double x = 1.5; x < 2.5; x += spacing) {
      for (double y = -0.5; y < 0.5; y += spacing) {
        const double z = -(kTilted.normal.x() * x + kTilted.normal.y() * y + kTilted.distance) / kTilted.normal.z();
        const Eigen::Vector3d point(x, y, z);
        const Eigen::Vector3d noise(dice.normal(0.01), dice.normal(0.01), dice.normal(0.01));
        cloud.push_back((point + off * point.normalized() + noise).cast<float>());
      }
    }
    const auto found = CloudPlaneFinder(options).find(cloud);
    EXPECT_EQ(found.planes.size(), 1U);
    for (const auto& plane : found.planes) {
      const Eigen::Vector3d error = geometry::minus(kTilted, plane.plane_in_sensor);
      chi2.push_back(error.dot(plane.covariance.inverse() * error));
    }
  }
  return chi2;
}

double sumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.);
}

// The sum has 600 degrees of freedom: 95 % lie within 534 and 670.
TEST(CloudPlaneFinder, TheCovarianceIsThatOfTwoHundredNoisyClouds) {
  auto options = everyPoint();
  options.bias_sigma = 0;
  options.gate = 5;  // so that hardly a point is left out
  const double sum = sumOf(chi2OfClouds(options, 0.02, 0));
  EXPECT_GT(sum, 534);
  EXPECT_LT(sum, 670);
}

TEST(CloudPlaneFinder, TheCovarianceCountsThePointsThatWereAveraged) {
  CloudPlaneOptions options;  // a voxel has some twenty points; the gate is the default
  options.bias_sigma = 0;
  const double sum = sumOf(chi2OfClouds(options, 0.006, 0));
  EXPECT_GT(sum, 534);
  EXPECT_LT(sum, 670);
}

TEST(CloudPlaneFinder, TheCovarianceCountsWhatAllPointsAreOffAlike) {
  CloudPlaneOptions options;
  const auto chi2 = chi2OfClouds(options, 0.01, options.bias_sigma);
  // The covariance also includes a change of the error over the view, which there is none of here.
  EXPECT_LT(sumOf(chi2), 670);
  EXPECT_GT(sumOf(chi2), 200);
  const auto beyond = std::count_if(chi2.begin(), chi2.end(), [](double value) { return value > 7.815; });
  EXPECT_LT(beyond, 0.08 * kClouds) << "5 % are beyond 7.815";
  options.bias_sigma = 0;
  EXPECT_GT(sumOf(chi2OfClouds(options, 0.01, 0.01)), 10000) << "by noise alone";
}

}  // namespace
}  // namespace omnimapper::perception::cloud_plane_finder_test

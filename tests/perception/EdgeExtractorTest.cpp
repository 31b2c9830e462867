#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMap.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/EdgeExtractor.h>

#include <map>
#include <string>
#include <thread>

#include "../camera/RangeScans.h"

namespace omnimapper::perception::edge_extractor_test {
namespace {

using namespace camera::scans;
using Points = std::vector<Eigen::Vector3f>;

// Depth [m]: 1 m left of the middle column, 2 m right of it.
const auto kStep = [](int x, int) { return x < kWidth / 2 ? 1. : 2.; };

std::map<std::string, Points> cloudsOf(const mrpt::obs::CObservation3DRangeScan& scan,
                                       const EdgeOptions& options = {}) {
  std::map<std::string, Points> clouds;
  for (const auto& derived : EdgeExtractor(options).extract(scan)) {
    EXPECT_EQ(derived->timestamp, scan.timestamp);
    EXPECT_EQ(derived->sensorPose, scan.sensorPose);
    Points& points = clouds[derived->sensorLabel];
    for (std::size_t i = 0; i < derived->pointcloud->size(); ++i) {
      Eigen::Vector3f p;
      derived->pointcloud->getPointFast(i, p.x(), p.y(), p.z());
      points.push_back(p);
    }
  }
  return clouds;
}

TEST(EdgeExtractor, GivesACloudForEachKindInTheSensorsFrame) {
  auto clouds = cloudsOf(rangeScan(kStep));
  ASSERT_EQ(clouds.size(), 4U) << "there is no picture";
  ASSERT_EQ(clouds["kinect.edges.occluding"].size(), kHeight);
  ASSERT_EQ(clouds["kinect.edges.occluded"].size(), kHeight);
  EXPECT_EQ(clouds["kinect.edges.boundary"].size(), 0U);
  EXPECT_EQ(clouds["kinect.edges.high_curvature"].size(), 0U);
  // x is ahead, y left, z up: column 79 is half a pixel left of the middle, row 0 is 59.5 pixels above it.
  EXPECT_LT((clouds["kinect.edges.occluding"][0] - Eigen::Vector3f(1, 0.005F, 0.595F)).norm(), 1e-4F);
  EXPECT_LT((clouds["kinect.edges.occluded"][0] - Eigen::Vector3f(2, -0.01F, 1.19F)).norm(), 1e-4F);
}

TEST(EdgeExtractor, GivesOnlyTheKindsThatAreWanted) {
  auto scan = rangeScan(kStep);
  addColours(scan);
  EdgeOptions options;
  options.jumps = options.high_curvature = false;
  auto clouds = cloudsOf(scan, options);
  ASSERT_EQ(clouds.size(), 1U);
  EXPECT_EQ(clouds["kinect.edges.rgb"].size(), kHeight);
  options.rgb = false;
  EXPECT_TRUE(cloudsOf(scan, options).empty());
}

TEST(EdgeExtractor, EdgesOfAPictureOfAnotherViewAreWhereTheDepthImageSeesThem) {
  EdgeOptions options;
  options.jumps = options.high_curvature = false;
  const auto wall = [](int, int) { return 2.; };
  for (const double scale : {0.5, 2., 3.}) {
    auto scan = rangeScan(wall);
    addColours(scan, static_cast<int>(scale * kWidth), static_cast<int>(scale * kHeight));
    const auto points = cloudsOf(scan, options)["kinect.edges.rgb"];
    EXPECT_GE(points.size(), static_cast<std::size_t>(kHeight)) << scale;
    for (const auto& p : points) EXPECT_LT(std::abs(p.y()), 2 * 3 / kFocal) << scale;
  }
  // The colour camera is 0.2 m to the right, and so is the middle of its picture, where red meets green.
  auto scan = rangeScan(wall);
  addColours(scan);
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -0.2, 0, -M_PI / 2, 0, -M_PI / 2);
  const auto points = cloudsOf(scan, options)["kinect.edges.rgb"];
  EXPECT_GE(points.size(), static_cast<std::size_t>(kHeight));
  for (const auto& p : points) EXPECT_NEAR(p.y(), -0.2, 0.03);
}

TEST(EdgeExtractor, ScansOfNothingGiveEmptyClouds) {
  for (const auto& [label, points] : cloudsOf(rangeScan([](int, int) { return 0.; })))
    EXPECT_TRUE(points.empty()) << label;
  EXPECT_EQ(cloudsOf(rangeScan(kStep, 0, 0)).size(), 4U);
  EXPECT_EQ(cloudsOf(rangeScan(kStep, 1, 1)).size(), 4U);
}

TEST(EdgeExtractor, ACameraWithoutCalibrationIsRefused) {
  auto scan = rangeScan(kStep);
  scan.cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_THROW(cloudsOf(scan), base::Error);
}

TEST(EdgeExtractor, SeveralThreadsAtOnceGetWhatOneGets) {
  auto scan = rangeScan(kStep);
  addColours(scan);
  const auto alone = cloudsOf(scan);
  std::vector<std::map<std::string, Points>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = cloudsOf(scan); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace omnimapper::perception::edge_extractor_test

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

namespace omnimapper::perception::laser_points_extractor_test {
namespace {

using mrpt::obs::CObservation2DRangeScan;

constexpr double kPi = 3.14159265358979323846;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

CObservation2DRangeScan scanOf(const std::vector<float>& ranges, double aperture = kPi) {
  CObservation2DRangeScan scan;
  scan.sensorLabel = "front";
  scan.timestamp = base::stampFromUnix(1e9);
  scan.sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0.1, 0, 0);
  scan.aperture = static_cast<float>(aperture);
  scan.maxRange = 30;
  scan.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.setScanRange(i, ranges[i]);
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

LaserPointsOptions everything() {
  LaserPointsOptions options;
  options.spacing = 0;
  options.isolated_distance = 0;
  return options;
}

std::vector<Eigen::Vector2d> pointsOf(const CObservation2DRangeScan& scan, const LaserPointsOptions& options) {
  const auto derived = LaserPointsExtractor(options).extract(scan);
  const auto& cloud = *dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*derived).pointcloud;
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    float x, y, z;
    cloud.getPointFast(i, x, y, z);
    EXPECT_EQ(z, 0);
    points.emplace_back(x, y);
  }
  return points;
}

void expectPoints(const std::vector<Eigen::Vector2d>& points, const std::vector<Eigen::Vector2d>& expected) {
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((points[i] - expected[i]).norm(), 1e-5) << i;
}

TEST(LaserPointsExtractor, BeamsBecomePointsInTheSensorFrameAsWorkedByHand) {
  auto scan = scanOf({1, 2, 3});
  scan.rightToLeft = true;
  expectPoints(pointsOf(scan, everything()), {{0, -1}, {2, 0}, {0, 3}});
  scan.rightToLeft = false;
  expectPoints(pointsOf(scan, everything()), {{0, 1}, {2, 0}, {0, -3}});
}

TEST(LaserPointsExtractor, TheCloudHasStampPoseAndLabelOfItsScan) {
  const auto scan = scanOf({1, 2, 3});
  const auto derived = LaserPointsExtractor(everything()).extract(scan);
  EXPECT_EQ(derived->timestamp, scan.timestamp);
  EXPECT_EQ(derived->sensorLabel, "front.points");
  mrpt::poses::CPose3D pose;
  derived->getSensorPose(pose);
  EXPECT_EQ(pose, scan.sensorPose);
}

TEST(LaserPointsExtractor, BeamsThatMeasuredNothingGiveNoPoint) {
  auto scan = scanOf({kNan, kInf, -kInf, 0, -1, 0.05F, 5, 31, 30, 29.9F, 5}, 1);
  scan.setScanRangeValidity(10, false);
  // The dropped beams are NaN, infinite, too near (three), beyond the sensor's range, and at its limit: no return.
  const auto points = pointsOf(scan, everything());
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[0].norm(), 5, 1e-5);
  EXPECT_NEAR(points[1].norm(), 29.9, 1e-5);
}

TEST(LaserPointsExtractor, TheUsersRangesHoldToo) {
  auto options = everything();
  options.min_range = 2;
  options.max_range = 4;
  EXPECT_EQ(pointsOf(scanOf({1, 2, 3, 4, 5}), options).size(), 3U);
}

TEST(LaserPointsExtractor, ScansOfNoneOneOrOnlyBadBeamsAreScansTheLess) {
  EXPECT_TRUE(pointsOf(scanOf({}), {}).empty());
  EXPECT_TRUE(pointsOf(scanOf({kNan, 0, kInf}), {}).empty());
  expectPoints(pointsOf(scanOf({7}), {}), {{7, 0}});
  expectPoints(pointsOf(scanOf({kNan, 0, 4, kInf, 0}), {}), {{4, 0}});
}

TEST(LaserPointsExtractor, APointFarFromBothNeighboursIsAMixedPixel) {
  LaserPointsOptions options = everything();
  options.isolated_distance = 0.5;
  std::vector<float> ranges(21, 2.0F);
  ranges[10] = 4;
  EXPECT_EQ(pointsOf(scanOf(ranges, 1), options).size(), 20U);
  EXPECT_EQ(pointsOf(scanOf(ranges, 1), everything()).size(), 21U);
  // On a far wall at coarse steps every point is far from its neighbours, but none is a mixed pixel.
  EXPECT_EQ(pointsOf(scanOf(std::vector<float>(10, 25.0F)), options).size(), 10U);
}

TEST(LaserPointsExtractor, KeptPointsAreSpacedAndEveryOtherIsNearOne) {
  testing::SimulatedLogOptions simulated;
  simulated.laps = 0.2;
  simulated.lasers[0].beams = 721;
  for (const double spacing : {0.05, 0.2}) {
    LaserPointsOptions options = everything();
    options.spacing = spacing;
    int scans = 0;
    for (const auto& observation : testing::SimulatedLog(simulated).observations()) {
      const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(observation.get());
      if (!scan || ++scans % 10 != 0) continue;
      const auto all = pointsOf(*scan, everything()), kept = pointsOf(*scan, options);
      EXPECT_LT(kept.size(), all.size());
      for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_GE((kept[i] - kept[i - 1]).norm(), spacing - 1e-5);
      for (const auto& point : all) {
        double nearest = kInf;
        for (const auto& other : kept) nearest = std::min(nearest, (other - point).norm());
        EXPECT_LT(nearest, spacing + 1e-5);
      }
    }
    EXPECT_GT(scans, 50);
  }
}

TEST(LaserPointsExtractor, SeveralThreadsAtOnceGetWhatOneGets) {
  testing::SimulatedLogOptions simulated;
  simulated.laps = 0.1;
  std::vector<CObservation2DRangeScan::Ptr> scans;
  for (const auto& observation : testing::SimulatedLog(simulated).observations()) {
    if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) scans.push_back(scan);
  }
  const LaserPointsExtractor extractor({});
  const auto work = [&] {
    std::vector<std::vector<float>> xs;
    for (const auto& scan : scans) {
      const auto derived = extractor.extract(*scan);
      const auto& points = *dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*derived).pointcloud;
      const auto& x = points.getPointsBufferRef_x();
      xs.emplace_back(x.begin(), x.end());
    }
    return xs;
  };
  const auto alone = work();
  std::vector<std::vector<std::vector<float>>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = work(); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace omnimapper::perception::laser_points_extractor_test

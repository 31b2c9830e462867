#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <cmath>

namespace omnimapper::plugins::laser_points_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[points]\nclass = LaserPointsExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"points"}, {}, {}}, config, {});
}

mrpt::obs::CObservation2DRangeScan scanOf(const std::vector<float>& ranges) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "laser";
  scan.timestamp = base::stampFromUnix(1e9);
  scan.sensorPose = mrpt::poses::CPose3D(1, 2, 3, 0, 0, 0);
  scan.maxRange = 50;
  scan.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.setScanRange(i, ranges[i]);
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

TEST(LaserPointsExtractorOfAnIni, TurnsScansAndNothingElseIntoClouds) {
  const auto set = made("");
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservationOdometry()));
  const auto scan = scanOf({2, 2, 2});
  ASSERT_TRUE(extractor.wants(scan));
  const auto derived = extractor.extract(scan);
  ASSERT_EQ(derived.size(), 1U);
  const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(derived.front());
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->sensorLabel, "laser.points");
  EXPECT_EQ(cloud->timestamp, scan.timestamp);
  EXPECT_EQ(cloud->sensorPose, scan.sensorPose);
}

TEST(LaserPointsExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  const auto count = [](const std::string& options) {
    const auto set = made("spacing_m = 0\nisolated_distance_m = 0\n" + options);
    const auto derived = set.extractors.front().plugin->extract(scanOf({2, 4, 6, 8}));
    return std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(derived.front())->pointcloud->size();
  };
  EXPECT_EQ(count(""), 4U);
  EXPECT_EQ(count("max_range_m = 5\n"), 2U);
  EXPECT_EQ(count("min_range_m = 3\n"), 3U);
  EXPECT_THROW(made("min_range_m = -1\n"), base::Error);
}

TEST(LaserPointsExtractorOfAnIni, LeavesOutTheFloorIfTheDeclaredPoseMeetsIt) {
  const auto set = made("isolated_distance_m = 0\n");
  const auto pointsAt = [&](const mrpt::poses::CPose3D& pose) {
    auto scan = scanOf({1, 2.9F, 3.1F});  // straight ahead, but for a degree
    scan.aperture = 0.02F;
    scan.sensorPose = pose;
    const auto derived = set.extractors.front().plugin->extract(scan);
    return std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(derived.front())->pointcloud->size();
  };
  const double pitch = std::asin(0.1);  // meets the floor at 3 m from a height of 0.3 m
  EXPECT_EQ(pointsAt({0, 0, 0.3, 0, pitch, 0}), 1U);
  EXPECT_EQ(pointsAt({0, 0, 0.3, 0, 0, 0}), 3U);
  EXPECT_EQ(pointsAt({0, 0, 0, 0, pitch, 0}), 3U) << "a height of 0 is not known rather than 0";
  EXPECT_EQ(pointsAt({0, 0, 0.3, 0, -pitch, 0}), 3U);
}

}  // namespace
}  // namespace omnimapper::plugins::laser_points_extractor_test

#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>

namespace omnimapper::plugins::edge_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[edges]\nclass = EdgeExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"edges"}, {}, {}}, config, {});
}

/// A board 1 m ahead of a wall at 2 m, 100 x 80 pixels.
mrpt::obs::CObservation3DRangeScan board() {
  mrpt::obs::CObservation3DRangeScan scan;
  scan.sensorLabel = "kinect";
  scan.timestamp = base::stampFromUnix(10);
  scan.hasRangeImage = true;
  scan.cameraParams.setIntrinsicParamsFromValues(100, 100, 49.5, 39.5);
  scan.rangeImage_setSize(80, 100);
  scan.rangeImage.fill(2000);
  scan.rangeImage.block(0, 0, 80, 50).fill(1000);
  return scan;
}

TEST(EdgeExtractorOfAnIni, TurnsDepthImagesAndNothingElseIntoCloudsOfEdges) {
  const auto set = made("");
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation2DRangeScan()));
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation3DRangeScan())) << "it has no depths";
  ASSERT_TRUE(extractor.wants(board()));
  std::size_t points = 0;
  for (const auto& derived : extractor.extract(board())) {
    EXPECT_EQ(derived->sensorLabel.rfind("kinect.edges.", 0), 0U);
    points += std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(derived)->pointcloud->size();
  }
  EXPECT_EQ(points, 2U * 80);
}

TEST(EdgeExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  EXPECT_EQ(made("high_curvature = false\n").extractors.front().plugin->extract(board()).size(), 3U);
  EXPECT_THROW(made("min_depth_m = 12\n"), base::Error);
  EXPECT_THROW(made("rgb_low = 200\n"), base::Error);
  EXPECT_THROW(made("relative_jump = 2\n"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::edge_extractor_test

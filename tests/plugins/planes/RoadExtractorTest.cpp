#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/obs/CObservationPlanes.h>

#include <cmath>

namespace omnimapper::plugins::road_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[road]\nclass = RoadExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"road"}, {}, {}}, config, {});
}

/// A floor 1 m below a camera that looks ahead.
mrpt::obs::CObservation3DRangeScan floorBelow() {
  mrpt::obs::CObservation3DRangeScan scan;
  scan.sensorLabel = "stereo";
  scan.timestamp = base::stampFromUnix(10);
  scan.sensorPose = mrpt::poses::CPose3D(0.1, 0, 1, 0, 0, 0);
  scan.hasRangeImage = true;
  scan.cameraParams.setIntrinsicParamsFromValues(100, 100, 49.5, 39.5);
  scan.rangeImage_setSize(80, 100);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 100; ++x)
      scan.rangeImage(y, x) = static_cast<std::uint16_t>(y > 45 ? std::lround(1000 * 100 / (y - 39.5)) : 0);
  }
  return scan;
}

std::size_t piecesOf(const std::string& options) {
  const auto set = made(options);
  const auto derived = set.extractors.front().plugin->extract(floorBelow());
  return std::dynamic_pointer_cast<obs::CObservationPlanes>(derived.at(0))->planes.size();
}

TEST(RoadExtractorOfAnIni, TurnsDepthImagesAndNothingElseIntoGround) {
  const auto set = made("");
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation2DRangeScan()));
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation3DRangeScan())) << "it has no depths";
  ASSERT_TRUE(extractor.wants(floorBelow()));
  const auto derived = extractor.extract(floorBelow());
  ASSERT_EQ(derived.size(), 1U);
  EXPECT_EQ(derived.front()->sensorLabel, "stereo.road");
  const auto found = std::dynamic_pointer_cast<obs::CObservationPlanes>(derived.front());
  ASSERT_EQ(found->planes.size(), 1U);
  EXPECT_LT((found->planes[0].plane_in_sensor.normal - Eigen::Vector3d(0, 0, 1)).norm(), 0.01);
  EXPECT_NEAR(found->planes[0].plane_in_sensor.distance, 1, 0.01);
}

TEST(RoadExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  EXPECT_EQ(piecesOf(""), 1U);
  EXPECT_EQ(piecesOf("ground_height_m = 0.9\nmax_off_m = 0.02\nmax_slope_deg = 0\n"), 0U);
  EXPECT_EQ(piecesOf("min_pixels = 8000\n"), 0U);
  EXPECT_THROW(made("min_depth_m = 20\n"), base::Error);
  EXPECT_THROW(made("max_slope_deg = 60\n"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::road_extractor_test

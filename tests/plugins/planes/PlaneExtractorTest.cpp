#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/obs/CObservationPlanes.h>

namespace omnimapper::plugins::plane_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[planes]\nclass = PlaneExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"planes"}, {}, {}}, config, {});
}

/// A wall 2 m ahead, 100 x 80 pixels.
mrpt::obs::CObservation3DRangeScan wall() {
  mrpt::obs::CObservation3DRangeScan scan;
  scan.sensorLabel = "kinect";
  scan.timestamp = base::stampFromUnix(10);
  scan.hasRangeImage = true;
  scan.cameraParams.setIntrinsicParamsFromValues(100, 100, 49.5, 39.5);
  scan.rangeImage_setSize(80, 100);
  scan.rangeImage.fill(2000);
  return scan;
}

std::size_t countOf(const std::string& options) {
  const auto set = made(options);
  const auto derived = set.extractors.front().plugin->extract(wall());
  return std::dynamic_pointer_cast<obs::CObservationPlanes>(derived.at(0))->planes.size();
}

TEST(PlaneExtractorOfAnIni, TurnsDepthImagesAndNothingElseIntoPlanes) {
  const auto set = made("");
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation2DRangeScan()));
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation3DRangeScan())) << "it has no depths";
  const auto scan = wall();
  ASSERT_TRUE(extractor.wants(scan));
  const auto derived = extractor.extract(scan);
  ASSERT_EQ(derived.size(), 1U);
  EXPECT_EQ(derived.front()->sensorLabel, "kinect.planes");
  EXPECT_EQ(derived.front()->timestamp, scan.timestamp);
}

// Its left half is dark.
mrpt::obs::CObservation3DRangeScan twoColours() {
  auto scan = wall();
  scan.hasIntensityImage = true;
  scan.cameraParamsIntensity = scan.cameraParams;
  scan.intensityImage = mrpt::img::CImage(100, 80, mrpt::img::CH_RGB);
  scan.intensityImage.filledRectangle(0, 0, 99, 79, mrpt::img::TColor(200, 200, 200));
  scan.intensityImage.filledRectangle(0, 0, 49, 79, mrpt::img::TColor(40, 40, 40));
  return scan;
}

TEST(PlaneExtractorOfAnIni, SwapsItsComparatorByTheIni) {
  const auto count = [](const std::string& options) {
    const auto derived = made(options).extractors.front().plugin->extract(twoColours());
    return std::dynamic_pointer_cast<obs::CObservationPlanes>(derived.at(0))->planes.size();
  };
  EXPECT_EQ(count(""), 1U);
  EXPECT_EQ(count("comparator = plane\n"), 1U);
  EXPECT_EQ(count("comparator = plane_colour\n"), 2U);
  EXPECT_EQ(count("comparator = plane_colour\nmax_colour_distance = 280\n"), 1U) << "160 sqrt(3) = 277";
  EXPECT_EQ(count("comparator = normals\n"), 1U);
  EXPECT_THROW(made("comparator = colour\n"), base::Error);
  EXPECT_THROW(made("max_colour_distance = 443\n"), base::Error);
  EXPECT_THROW(countOf("comparator = plane_colour\n"), base::Error) << "no picture";
}

TEST(PlaneExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  EXPECT_EQ(countOf(""), 1U);
  EXPECT_EQ(countOf("outline_tolerance_px = 0\n"), 1U);
  EXPECT_EQ(countOf("max_depth_m = 1.5\n"), 0U);
  EXPECT_EQ(countOf("min_pixels = 8001\n"), 0U);
  EXPECT_THROW(made("min_depth_m = 12\n"), base::Error);
  EXPECT_THROW(made("outline_tolerance_px = -1\n"), base::Error);
  EXPECT_THROW(made("tolerance_px = 1\n"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::plane_extractor_test

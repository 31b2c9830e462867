#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/CObservationPlanes.h>

namespace omnimapper::plugins::object_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[objects]\nclass = ObjectExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"objects"}, {}, {}}, config, {});
}

TEST(ObjectExtractorOfAnIni, TurnsDepthImagesIntoPlanesAndObjects) {
  const auto set = made("");
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservation2DRangeScan()));
  mrpt::obs::CObservation3DRangeScan scan;
  EXPECT_FALSE(extractor.wants(scan)) << "it has no depths";
  scan.hasRangeImage = true;
  scan.sensorLabel = "kinect";
  ASSERT_TRUE(extractor.wants(scan));
  const auto derived = extractor.extract(scan);
  ASSERT_EQ(derived.size(), 2U);
  EXPECT_TRUE(std::dynamic_pointer_cast<obs::CObservationPlanes>(derived[0]));
  EXPECT_EQ(derived[0]->sensorLabel, "kinect.planes");
  EXPECT_TRUE(std::dynamic_pointer_cast<obs::CObservationObjects>(derived[1]));
  EXPECT_EQ(derived[1]->sensorLabel, "kinect.objects");
}

TEST(ObjectExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  EXPECT_NO_THROW(made("min_pixels = 500\noutline_tolerance_px = 2\nmax_tilt_deg = 75\nmax_points = 10\n"));
  EXPECT_NO_THROW(made("comparator = euclidean\n"));
  EXPECT_THROW(made("comparator = guess\n"), base::Error);
  EXPECT_THROW(made("max_tilt_deg = 200\n"), base::Error);
  EXPECT_THROW(made("max_points = 0\n"), base::Error);
  EXPECT_THROW(made("min_depth_m = 12\n"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::object_extractor_test

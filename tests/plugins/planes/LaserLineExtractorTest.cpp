#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/testing/LineScans.h>

namespace omnimapper::plugins::laser_line_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[walls]\nclass = LaserLineExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"walls"}, {}, {}}, config, {});
}

std::size_t countOf(const std::string& options) {
  testing::Dice dice(3);
  const auto set = made(options);
  const auto derived = set.extractors.front().plugin->extract(testing::drawLineScan({}, dice).scan);
  return std::dynamic_pointer_cast<obs::CObservationLaserLines>(derived.at(0))->lines.size();
}

TEST(LaserLineExtractorOfAnIni, TurnsScansAndNothingElseIntoLines) {
  const auto set = made("");
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_FALSE(extractor.wants(mrpt::obs::CObservationOdometry()));
  testing::Dice dice(3);
  const auto scan = testing::drawLineScan({}, dice).scan;
  ASSERT_TRUE(extractor.wants(scan));
  const auto derived = extractor.extract(scan);
  ASSERT_EQ(derived.size(), 1U);
  EXPECT_EQ(derived.front()->sensorLabel, "laser.lines");
  EXPECT_EQ(derived.front()->timestamp, scan.timestamp);
}

TEST(LaserLineExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  EXPECT_GT(countOf(""), 1U);
  EXPECT_GT(countOf("method = ransac\n"), 1U);
  EXPECT_EQ(countOf("min_length_m = 50\n"), 0U);
  EXPECT_THROW(made("method = guess\n"), base::Error);
  EXPECT_THROW(made("gate_sigmas = 0\n"), base::Error);
  EXPECT_THROW(made("min_points = 2\n"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::laser_line_extractor_test

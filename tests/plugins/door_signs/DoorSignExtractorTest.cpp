#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/testing/MapperRun.h>

#include <string>

namespace omnimapper::plugins::door_sign_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[signs]\nclass = DoorSignExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"signs"}, {}, {}}, config, {});
}

// Without networks it says where they come from.
TEST(DoorSignExtractorOfAnIni, readsItsOptionsAndNeedsNetworks) {
  EXPECT_THROW(made("backend = abacus\n"), base::Error);
  EXPECT_THROW(made("min_confidence = 2\n"), base::Error);
  try {
    made("models = /dev/null\n");
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input) << error.what();
    EXPECT_NE(std::string(error.what()).find("scripts/models"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::plugins::door_sign_extractor_test

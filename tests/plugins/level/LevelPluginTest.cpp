#include <gtest/gtest.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <string>
#include <vector>

#include "level/LevelPlugin.h"

namespace omnimapper::plugins::level_plugin_test {
namespace {

using map::Level;

// The level of a robot that drove through a room with a laser; null if the map has none.
const Level* levelOf(const mapper::Engine& engine) {
  return engine.view().map.layers.find<Level>();
}

std::unique_ptr<mapper::Engine> finished(const std::vector<std::string>& settings, const std::string& ini = "") {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  auto engine = testing::makeEngine(testing::kLaserIni + ini, settings);
  testing::run(*engine, testing::SimulatedLog(options).observations());
  return engine;
}

std::vector<std::string> sectionsOf(const mapper::Engine& engine) {
  std::vector<std::string> sections;
  for (const auto& [section, plugin] : engine.plugins().measurement) sections.push_back(section);
  return sections;
}

TEST(LevelPlugin, IsInEveryRunBeforeTheListedPlugins) {
  const auto engine = finished({});
  EXPECT_EQ(sectionsOf(*engine), (std::vector<std::string>{"LevelPlugin", "loop_closure"}));
  ASSERT_NE(levelOf(*engine), nullptr);
  EXPECT_EQ(levelOf(*engine)->source, Level::Source::base);
  EXPECT_EQ(levelOf(*engine)->up, Eigen::Vector3d::UnitZ());
}

TEST(LevelPlugin, TakesItsOptionsFromASectionOfItsName) {
  const auto engine = finished({}, "[LevelPlugin]\nbase_sigma_deg = 3\n");
  ASSERT_NE(levelOf(*engine), nullptr);
  EXPECT_NEAR(levelOf(*engine)->standardDeviation(), 3 * base::option_text::kRadiansPerDegree, 1e-12);
}

TEST(LevelPlugin, UnderAnotherNameReplacesTheDefaultOne) {
  const auto engine =
      finished({"mapper.measurement_plugins=loop_closure, up"}, "[up]\nclass = LevelPlugin\nbase_sigma_deg = 2\n");
  EXPECT_EQ(sectionsOf(*engine), (std::vector<std::string>{"loop_closure", "up"}));
  ASSERT_NE(levelOf(*engine), nullptr);
  EXPECT_NEAR(levelOf(*engine)->standardDeviation(), 2 * base::option_text::kRadiansPerDegree, 1e-12);
}

TEST(LevelPlugin, CanBeSwitchedOff) {
  const auto engine = finished({"mapper.default_plugins="});
  EXPECT_EQ(sectionsOf(*engine), (std::vector<std::string>{"loop_closure"}));
  EXPECT_EQ(levelOf(*engine), nullptr);
}

TEST(LevelPlugin, MakesNoKeyFramesAndKeepsThoseOfPoseSources) {
  const auto with = finished({"mapper.measurement_plugins="});
  const auto without = finished({"mapper.measurement_plugins=", "mapper.default_plugins="});
  EXPECT_GT(with->view().map.key_frames.size(), 2u);
  EXPECT_EQ(testing::bitsOf(with->view()), testing::bitsOf(without->view()));
}

}  // namespace
}  // namespace omnimapper::plugins::level_plugin_test

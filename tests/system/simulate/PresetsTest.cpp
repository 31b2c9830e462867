// Every INI of rawlogs/, and the example in its README, gives a world in which all sensors have measurements.
#include <omnimapper/base/Config.h>
#include <omnimapper/sim/Simulation.h>

#include <algorithm>

#include "SimulateRun.h"

namespace {

using namespace runs;
using omnimapper::base::Config;
using omnimapper::sim::Simulation;
using omnimapper::testing::sourceFile;

std::vector<std::string> presets() {
  std::vector<std::string> names;
  for (const std::string& file : filesIn(sourceFile("rawlogs"))) {
    if (fs::path(file).extension() == ".ini") names.push_back(fs::path(file).stem().string());
  }
  return names;
}

// Expects that each sensor measures something in at least one of about 20 measurements, which are spread over the run.
void expectMeasures(const Simulation& simulation) {
  for (const auto& sensor : simulation.sensors()) {
    bool measures = false;
    const int step = std::max(1, sensor->count() / 20);
    for (int k = 0; k < sensor->count() && !measures; k += step) measures = sensor->measure(k).observation != nullptr;
    EXPECT_TRUE(measures) << sensor->label();
  }
}

class Presets : public ::testing::TestWithParam<std::string> {};

TEST_P(Presets, AreMadeWithoutAWarningAndAllTheirSensorsMeasure) {
  const Simulation simulation(Config::fromFile(sourceFile("rawlogs/" + GetParam() + ".ini")));
  EXPECT_EQ(simulation.warnings(), Texts());
  EXPECT_GT(simulation.duration(), 10);
  expectMeasures(simulation);
}

INSTANTIATE_TEST_SUITE_P(Rawlogs, Presets, ::testing::ValuesIn(presets()), [](const auto& info) { return info.param; });

TEST(Presets, AreAllThere) {
  EXPECT_GE(presets().size(), 10U);
}

TEST(RawlogsReadme, ItsExampleOverThePresetItNamesIsAPlace) {
  const std::string page = readFile(sourceFile("rawlogs/README.md"));
  const std::string opening = "```ini\n";
  const auto begin = page.rfind(opening);
  ASSERT_NE(begin, std::string::npos);
  const auto first = begin + opening.size();
  const omnimapper::testing::ScratchFolder scratch;
  const std::string example = writeFile(scratch / "mine.ini", page.substr(first, page.find("```", first) - first));
  ASSERT_NE(page.find("-i rawlogs/home.ini -i mine.ini"), std::string::npos);
  const Simulation simulation(Config::fromFiles({sourceFile("rawlogs/home.ini"), example}));
  EXPECT_EQ(simulation.warnings(), Texts());
  EXPECT_EQ(simulation.world().people.size(), 1U);
  const auto& objects = simulation.world().objects;
  EXPECT_TRUE(std::any_of(objects.begin(), objects.end(), [](const auto& object) { return object.name == "my_cup"; }));
  expectMeasures(simulation);
}

}  // namespace

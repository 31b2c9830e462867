#include <gtest/gtest.h>
#include <omnimapper/plugin/FactoryOf.h>
#include <omnimapper/testing/BoxWorld.h>
#include <omnimapper/testing/Fixtures.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "grid_map/GridOutput.h"
#include "map_file/MapOutput.h"
#include "plan/GeoJsonOutput.h"
#include "plan/SurfacesOutput.h"
#include "report/ReportOutput.h"
#include "run_files/GraphOutput.h"
#include "run_files/SummaryOutput.h"
#include "run_files/TrajectoryOutput.h"
#include "scene/PointsOutput.h"
#include "scene/SceneOutput.h"

namespace output_errors_test {
namespace {

using namespace box_world;
using omnimapper::testing::ScratchFolder;

struct OutputCase {
  std::shared_ptr<const mapper::OutputPluginFactory> factory;
  std::vector<std::string> files;
};

template <class Made, class Options>
OutputCase outputOf(std::vector<std::string> files) {
  return {std::make_shared<mapper::FactoryOf<Made, Options>>(), std::move(files)};
}

const std::vector<OutputCase>& cases() {
  static const std::vector<OutputCase> cases{
      outputOf<plugins::TrajectoryOutput, plugins::TrajectoryOptions>({"trajectory.tum"}),
      outputOf<plugins::GeoJsonOutput, plugins::GeoJsonOptions>({"floorplan.geojson"}),
      outputOf<plugins::SurfacesOutput, plugins::SurfacesOptions>({"surfaces.json"}),
      outputOf<plugins::GraphOutput, plugins::GraphOutputOptions>({"graph.g2o"}),
      outputOf<plugins::GridOutput, plugins::GridOptions>({"grid.pgm", "grid.yaml", "grid.png"}),
      outputOf<plugins::PointsOutput, derived::PointsOptions>({"points.ply"}),
      outputOf<plugins::SceneOutput, plugins::SceneOptions>({"scene.3Dscene"}),
      outputOf<plugins::MapOutput, plugins::MapOutputOptions>({"map.omnimap"}),
      outputOf<plugins::SummaryOutput, plugins::SummaryOptions>({"summary.json"}),
      outputOf<plugins::ReportOutput, plugins::ReportOptions>({"map.png", "report.html"})};
  return cases;
}

std::unique_ptr<mapper::OutputPlugin> make(const OutputCase& output, const std::string& folder,
                                           const std::string& ini = "") {
  const auto config = base::Config::fromText(ini, "test.ini");
  return output.factory->make(config.section("output"), contextFor(folder));
}

std::set<std::string> filesIn(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

/// The message of the exception that `act` throws; empty if it throws nothing.
template <class Act>
std::string failure(base::ExitCode code, const Act& act) {
  try {
    act();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return {};
}

TEST(Outputs, eachWritesItsFilesAndNothingElse) {
  for (const OutputCase& output : cases()) {
    ScratchFolder folder;
    make(output, folder.path())->finish(boxRun().view());
    EXPECT_EQ(filesIn(folder.path()), std::set<std::string>(output.files.begin(), output.files.end()));
    for (const std::string& file : output.files) EXPECT_GT(std::filesystem::file_size(folder / file), 50u) << file;
  }
}

TEST(Outputs, anEmptyMapIsNoError) {
  ScratchFolder folder;
  for (const OutputCase& output : cases()) {
    EXPECT_NO_THROW(make(output, folder.path())->finish(RunRecord().view())) << output.factory->name();
  }
}

TEST(Outputs, aFolderThatWentAwayIsAnErrorNamingTheFile) {
  ScratchFolder folder;
  for (const OutputCase& output : cases()) {
    const auto plugin = make(output, folder / "gone");
    const std::string message = failure(base::ExitCode::unwritable_output, [&] { plugin->finish(boxRun().view()); });
    EXPECT_NE(message.find(output.files[0]), std::string::npos) << output.factory->name() << ": " << message;
  }
}

TEST(Outputs, aFullDiskIsAnErrorAndKeepsTheOldFile) {
  for (const OutputCase& output : cases()) {
    ScratchFolder folder;
    const std::filesystem::path file = folder / output.files[0];
    std::ofstream(file) << "the previous run";
    const auto plugin = make(output, folder.path());
    const auto run = boxRun();
    const std::string message = failure(base::ExitCode::disk_full, [&] {
      const omnimapper::testing::SmallFiles full(16);
      plugin->finish(run.view());
    });
    EXPECT_NE(message.find(output.files[0]), std::string::npos) << output.factory->name() << ": " << message;
    EXPECT_EQ(contentOf(file), "the previous run") << output.factory->name();
  }
}

TEST(Outputs, aRunWithoutAFolderRefusesThem) {
  for (const OutputCase& output : cases()) {
    const std::string message = failure(base::ExitCode::unwritable_output, [&] { make(output, ""); });
    EXPECT_NE(message.find("-o"), std::string::npos) << output.factory->name();
  }
}

TEST(Outputs, optionsAreReadAndMisspeltOnesRefused) {
  ScratchFolder folder;
  for (const OutputCase& output : cases()) {
    EXPECT_EQ(output.factory->kind(), mapper::PluginKind::output);
    std::string ini = "[output]\nclass = " + output.factory->name() + "\n";
    for (const auto& option : output.factory->options()) ini += option.key + " = " + option.default_value + "\n";
    EXPECT_NO_THROW(make(output, folder.path(), ini)) << ini;
    const std::string message =
        failure(base::ExitCode::unknown_key, [&] { make(output, folder.path(), ini + "resolution = 1\n"); });
    EXPECT_NE(message.find("resolution"), std::string::npos) << output.factory->name() << ": " << message;
  }
}

}  // namespace
}  // namespace output_errors_test

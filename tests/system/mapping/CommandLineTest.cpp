// Options and messages of omnimapper-graphslam's command line that do not concern mapping itself.
#include <omnimapper/base/Config.h>
#include <omnimapper/net/Network.h>

#include <regex>
#include <sstream>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

/// Classes that --list-plugins prints, by heading such as "pose plugins".
std::map<std::string, Texts> listedPlugins() {
  const auto ended = graphslam({"--list-plugins"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended));
  std::map<std::string, Texts> listed;
  std::istringstream in(ended.out);
  std::string heading;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (line[0] != ' ') {
      heading = line;
      continue;
    }
    std::istringstream words(line);
    std::string name, summary;
    words >> name;
    std::getline(words, summary);
    EXPECT_GT(summary.size(), 20U) << name << " is not explained";
    listed[heading].push_back(name);
  }
  return listed;
}

// Whether scripts/models was run: without networks the door sign extractor refuses to start.
bool hasSignNetworks() {
  const auto folder = omnimapper::net::modelsFolder();
  return std::filesystem::exists(folder + "/text_detector.onnx") &&
         std::filesystem::exists(folder + "/text_reader.onnx");
}

std::string joined(const Texts& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

class CommandLine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchFolder>();
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    options.laps = 0.5;
    SimulatedLog(options).writeRawlog(file("box.rawlog"));
  }
  static void TearDownTestSuite() { scratch_.reset(); }
  static std::string file(const std::string& name) { return *scratch_ / name; }

  static inline std::unique_ptr<ScratchFolder> scratch_;
};

TEST_F(CommandLine, HelpOfEveryProgramHasAnExample) {
  for (const char* program : {"omnimapper-graphslam", "omnimapper-import", "omnimapper-eval"}) {
    const auto ended = omnimapper::testing::runProgram({omnimapper::testing::ownProgram(program), "--help"});
    EXPECT_TRUE(endedWith(ExitCode::ok, ended));
    EXPECT_TRUE(std::regex_search(ended.out, std::regex(std::string("Examples?:\\s+") + program + " "))) << ended.out;
    EXPECT_EQ(ended.err, "");
  }
}

TEST_F(CommandLine, MistakesAreRefusedWithTheirCode) {
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({}), {"-i", "-r", "-o", "--help"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({"--rawlogs"}), {"--rawlogs"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({"-i"}), {"--ini"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({"--threads", "0"}), {"--threads"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({"--speed", "-1"}), {"--speed"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, map({"x.rawlog"}, file("map"), {"--set", "window_s=2"}),
                        {"--set window_s=2", "section.key=value"}));
}

TEST_F(CommandLine, MistakesAreAnsweredWithWhatWasMeant) {
  const std::string log = file("x.rawlog"), out = file("x");
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, graphslam({"-i", "laser.ini", "-r", log, "-o", out}),
                        {"laser.ini", "did you mean laser2d.ini?", "home_planes.ini"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, graphslam({"-i", "ini/laser2d.ini", "-r", log, "-o", out}), {log}))
      << "an installed INI is also found under the folder that it has in a checkout";
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({"--ouput", out}), {"did you mean --output?"}));
  EXPECT_TRUE(
      endedWith(ExitCode::command_line, graphslam({"nowhere"}), {"'nowhere' is given without an option; --help"}));
  std::ofstream(log) << "a log";
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({log}), {"did you mean -r " + log + "?"}));
  EXPECT_TRUE(
      endedWith(ExitCode::command_line, graphslam({"-i", "laser2d.ini", "-o", out}), {"this is missing: -r LOG;"}));
}

TEST_F(CommandLine, EveryListedPluginPrintsASectionThatRuns) {
  auto plugins = listedPlugins();
  ASSERT_EQ(plugins.size(), 5U) << "pose, measurement and output plugins, extractors, and formats of logs";
  ASSERT_EQ(plugins.erase("formats of logs"), 1U);
  std::string ini;
  std::map<std::string, Texts> sections;
  const std::regex title(R"(\[(\w+)\]\nclass = (\w+)\n)");
  for (auto& [heading, classes] : plugins) {
    for (const auto& name : classes) {
      const auto ended = graphslam({"--print-ini", name});
      ASSERT_TRUE(endedWith(ExitCode::ok, ended));
      std::smatch found;
      ASSERT_TRUE(std::regex_search(ended.out, found, title)) << ended.out;
      EXPECT_EQ(found[2], name);
      if (name == "LiveWindow") continue;  // needs a display: GuiTest
      if (name == "LivePage") continue;    // stays until Ctrl-C: ServeTest
      if (name == "DoorSignExtractor" && !hasSignNetworks()) continue;
      ini += ended.out + "\n";
      sections[heading].push_back(found[1]);
    }
  }
  ini += "[mapper]\npose_plugins = " + joined(sections["pose plugins"]) +
         "\nmeasurement_plugins = " + joined(sections["measurement plugins"]) +
         "\noutput_plugins = " + joined(sections["output plugins"]) +
         "\n[perception]\nextractors = " + joined(sections["extractors"]) + "\n";
  writeFile(file("all.ini"), ini);
  EXPECT_TRUE(endedWith(ExitCode::ok, graphslam({"-i", file("all.ini"), "-r", file("box.rawlog"), "-o", file("all")})));
  auto expected = allOutputs();
  expected.insert({"floorplan.geojson", "landmarks.ply", "surfaces.json",
                   "objects.json"});  // outputs of walls and objects, which ini/laser2d.ini does not have
  EXPECT_EQ(filesIn(file("all")), expected);
  if (!hasSignNetworks())
    GTEST_SKIP() << "ran without DoorSignExtractor: its networks are missing; scripts/models fetches them";
}

TEST_F(CommandLine, UnknownPluginToPrintIsAnsweredWithTheNearest) {
  EXPECT_TRUE(
      endedWith(ExitCode::unknown_plugin, graphslam({"--print-ini", "LoopClosePlugin"}), {"'LoopClosurePlugin'"}));
}

TEST_F(CommandLine, SetOverrulesTheIni) {
  const auto keyFrames = [&](const Texts& more) {
    EXPECT_TRUE(endedWith(ExitCode::ok, map({file("box.rawlog")}, file("set"), more)));
    return loadMap(file("set")).map.key_frames.size();
  };
  const auto usual = keyFrames({});
  EXPECT_LT(keyFrames({"--set", "trigger.distance_m=1", "--set", "trigger.angle_deg=90"}), usual);
  EXPECT_GT(keyFrames({"--set", "trigger.every_observation=true"}), usual);
}

TEST_F(CommandLine, OutputsCanBeSwitchedOff) {
  const auto ended = map({file("box.rawlog")}, file("few"), {"--set", "mapper.output_plugins=map, trajectory"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended, {"warning", "graph, grid", "switched off"}));
  EXPECT_EQ(filesIn(file("few")), (std::set<std::string>{"map.omnimap", "trajectory.tum"}));
}

TEST_F(CommandLine, QuietPrintsNothingAndVerboseWhatTheLogHolds) {
  const auto quiet = map({file("box.rawlog")}, file("quiet"), {"-q"});
  EXPECT_TRUE(endedWith(ExitCode::ok, quiet));
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(filesIn(file("quiet")), allOutputs());
  const auto verbose = map({file("box.rawlog")}, file("quiet"), {"-v"});
  EXPECT_NE(verbose.out.find("mrpt::obs::CObservation2DRangeScan"), std::string::npos) << verbose.out;
}

// A pace is a duration of the log by one of mapping, and is the same wherever it is told.
TEST_F(CommandLine, ScreenAndReportTellOnePace) {
  const omnimapper::testing::ScratchFolder scratch;
  const auto ended = map({omnimapper::testing::sourceFile("rawlogs/box/box.rawlog")}, scratch / "map");
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  std::smatch pace;
  ASSERT_TRUE(std::regex_search(ended.out, pace, std::regex(R"(mapped in .* s, ([0-9.]+) times the log's own pace)")))
      << ended.out;
  EXPECT_NE(readFile(scratch / "map/report.html").find(">" + pace[1].str() + " &#215;<"), std::string::npos) << pace[1];
}

}  // namespace

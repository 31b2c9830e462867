// omnimapper-simulate: impossible worlds, folders that cannot be written, Ctrl-C.
#include <signal.h>

#include <thread>

#include "SimulateRun.h"

namespace {

using namespace runs;
using omnimapper::testing::Program;

class SimulateMistakes : public ::testing::Test {
 protected:
  SimulateMistakes() { writeFile(ini_, kSmallWorld); }
  Ended with(const Texts& settings, const ProgramOptions& options = {}) {
    Texts words{"-i", ini_, "-o", folder_};
    for (const auto& setting : settings) words.insert(words.end(), {"--set", setting});
    return simulate(words, options);
  }

  omnimapper::testing::ScratchFolder scratch_;
  const std::string ini_ = scratch_ / "small.ini", folder_ = scratch_ / "out";
};

TEST_F(SimulateMistakes, AreRefusedWithTheirPlaceInTheIni) {
  struct Case {
    Texts settings;
    ExitCode code;
    Texts words;
  };
  const std::vector<Case> cases{
      {{"kitchen.rectangle_m=3 0 8 4"}, ExitCode::out_of_range, {"small.ini", "[kitchen]", "hall"}},
      {{"robot.waypoints=1 1, 20 20"}, ExitCode::out_of_range, {"small.ini", "[robot]", "waypoints", "20 20"}},
      {{"robot.waypoints=1 1, 5.07 0.5"}, ExitCode::out_of_range, {"small.ini", "[robot]", "waypoints"}},
      {{"laser.rate_hz=0"}, ExitCode::out_of_range, {"--set laser.rate_hz", "[laser]", "rate_hz"}},
      {{"table_1.class=tabel"}, ExitCode::unknown_plugin, {"small.ini", "[table_1]", "table"}},
      {{"laser.class=Lazer2d"}, ExitCode::unknown_plugin, {"small.ini", "[laser]", "Laser2d"}},
      {{"laser.rate=5"}, ExitCode::unknown_key, {"--set laser.rate", "[laser]", "rate_hz"}},
      {{"world.generator=hom"}, ExitCode::out_of_range, {"small.ini", "[world]", "home"}},
      {{"simulation.sensors="}, ExitCode::out_of_range, {"small.ini", "[simulation]", "sensors"}},
      {{"simulation.sensors=lazer"}, ExitCode::out_of_range, {"small.ini", "[simulation]", "no section [lazer]"}},
      {{"world.rooms=", "world.doors=", "world.furniture="}, ExitCode::out_of_range, {"small.ini", "has no rooms"}},
      {{"hall.wall=gold"}, ExitCode::out_of_range, {"small.ini", "[hall]", "wall", "paint_white"}},
      {{"camera.label=laser"}, ExitCode::out_of_range, {"small.ini", "[camera]", "label", "[laser]"}},
      {{"door_1.x_m=2", "door_1.y_m=0"}, ExitCode::out_of_range, {"small.ini", "[door_1]"}},
      {{"table_1.x_m=5"}, ExitCode::out_of_range, {"small.ini", "[table_1]"}},
  };
  for (const auto& [settings, code, words] : cases) {
    const auto ended = with(settings);
    EXPECT_TRUE(endedWith(code, ended, words)) << settings.front();
    EXPECT_FALSE(fs::exists(folder_)) << settings.front();
  }
}

TEST_F(SimulateMistakes, FoldersThatCannotBeMadeAreReported) {
  writeFile(scratch_ / "file", "");
  EXPECT_TRUE(
      endedWith(ExitCode::unwritable_output, simulate({"-i", ini_, "-o", scratch_ / "file/out"}), {"file/out"}));
  EXPECT_TRUE(
      endedWith(ExitCode::unreadable_input, simulate({"-i", scratch_ / "none.ini", "-o", folder_}), {"none.ini"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, simulate({"-i", ini_}), {"-o FOLDER"}));
}

TEST_F(SimulateMistakes, AFullDiskLeavesNoHalfLog) {
  ProgramOptions limited;
  limited.largest_file = 50000;
  EXPECT_TRUE(endedWith(ExitCode::disk_full, with({}, limited), {folder_}));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(SimulateMistakes, AFullDiskKeepsTheOlderRunWhole) {
  // A log with odometry alone is smaller than the list of landmarks, for which the disk then has no room.
  const Texts settings{"simulation.sensors=odometry", "simulation.duration_s=1"};
  ASSERT_TRUE(endedWith(ExitCode::ok, with(settings)));
  const auto before = contentOf(folder_);
  ASSERT_GT(before.at("landmarks.json").size(), before.at("small.rawlog").size() + 1000);
  ProgramOptions limited;
  limited.largest_file = before.at("small.rawlog").size() + 500;
  EXPECT_TRUE(endedWith(ExitCode::disk_full, with({settings[0], settings[1], "simulation.seed=9"}, limited)));
  EXPECT_TRUE(contentOf(folder_) == before);
}

TEST_F(SimulateMistakes, FilesOfSomebodyElseAreNotReplaced) {
  fs::create_directories(folder_ + "/pictures");
  writeFile(folder_ + "/README.md", "# My cat\n");
  writeFile(folder_ + "/pictures/cat.png", "cat");
  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, with({}), {folder_, "no simulated log"}));
  EXPECT_EQ(contentOf(folder_).size(), 2U);
  EXPECT_EQ(readFile(folder_ + "/README.md"), "# My cat\n");
}

TEST_F(SimulateMistakes, CtrlCLeavesNoImagesOfWhatIsNotInTheLog) {
  Program program({omnimapper::testing::ownProgram("omnimapper-simulate"), "-i", ini_, "-o", folder_, "--set",
                   "simulation.duration_s=3000", "--set", "simulation.images=external", "--set",
                   "simulation.sensors=camera"});
  while (filesIn(folder_ + "/.omnimapper/staged/small_Images").size() < 80 && program.isRunning())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.send(SIGINT);
  ASSERT_TRUE(endedWith(ExitCode::interrupted, program.wait()));
  const auto observations = readLog(folder_ + "/small.rawlog").observations();
  EXPECT_GT(observations, 0U);
  EXPECT_EQ(filesIn(folder_ + "/small_Images").size(), 2 * observations) << "a colour and a depth image of each";
  EXPECT_FALSE(fs::exists(folder_ + "/.omnimapper/staged"));
}

TEST_F(SimulateMistakes, CtrlCLeavesWhatWasMeasuredUntilThen) {
  Program program({omnimapper::testing::ownProgram("omnimapper-simulate"), "-i", ini_, "-o", folder_, "--set",
                   "simulation.duration_s=3000"});
  // The truth of an observation is written after it.
  while (!fs::exists(folder_ + "/.omnimapper/staged/truth") && program.isRunning())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.send(SIGINT);
  const auto ended = program.wait();
  ASSERT_TRUE(endedWith(ExitCode::interrupted, ended));
  EXPECT_NE(ended.out.find("(interrupted)"), std::string::npos) << ended.out;
  const auto report = readLog(folder_ + "/small.rawlog");
  EXPECT_EQ(report.ending, omnimapper::source::SourceReport::Ending::complete) << report.message;
  EXPECT_GT(report.observations(), 0U);
  EXPECT_TRUE(fs::exists(folder_ + "/truth.tum"));
  EXPECT_TRUE(fs::exists(folder_ + "/README.md"));
}

}  // namespace

// Outputs that cannot be written: the exit code gives the cause, and outputs of an earlier run stay whole.
#include <signal.h>
#include <sys/mount.h>

#include <array>
#include <chrono>
#include <thread>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

/// Mounts a disk of that size on a folder while the object exists.
class SmallDisk {
 public:
  SmallDisk(const std::string& folder, const std::string& size) : folder_(folder) {
    fs::create_directories(folder);
    mounted_ = ::mount("omnimapper-test", folder.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::string folder_;
  bool mounted_;
};

class OutputFolder : public ::testing::Test {
 protected:
  OutputFolder() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    options.laps = 0.5;
    SimulatedLog(options).writeRawlog(log_path_);
  }

  ScratchFolder scratch_;
  std::string log_path_ = scratch_ / "box.rawlog";
};

TEST_F(OutputFolder, IsMadeWithItsParents) {
  EXPECT_TRUE(endedWith(ExitCode::ok, map({log_path_}, scratch_ / "a/b/c")));
  EXPECT_EQ(filesIn(scratch_ / "a/b/c"), allOutputs());
}

TEST_F(OutputFolder, ThatCannotBeMadeOrWrittenIsRefusedByName) {
  const std::string file = writeFile(scratch_ / "file", "a file");
  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, map({log_path_}, file), {file, "is a file, but a folder"}));
  for (const std::string& folder : {file + "/below", std::string("/proc/self")}) {
    EXPECT_TRUE(endedWith(ExitCode::unwritable_output, map({log_path_}, folder), {folder, "permissions"}));
  }
  EXPECT_EQ(readFile(file), "a file");
}

TEST_F(OutputFolder, OnAFullDiskKeepsTheOldMapAndNamesAllThatFailed) {
  const std::string folder = scratch_ / "disk";
  const SmallDisk disk(folder, "1m");
  if (!disk.mounted()) GTEST_SKIP() << "mounting a small disk is not permitted; FilesThatMayNotGrow... has run";
  const std::string old_map = "the map of before";
  writeFile(folder + "/map.omnimap", old_map);
  writeFile(folder + "/filler", std::string(930'000, 'x'));
  EXPECT_TRUE(endedWith(
      ExitCode::disk_full, map({log_path_}, folder),
      {folder + "/map.omnimap: ", folder + "/map.png: ", "No space left on device", "Free some room", "is unchanged"}));
  EXPECT_EQ(readFile(folder + "/map.omnimap"), old_map);
  EXPECT_EQ(filesIn(folder), (std::set<std::string>{"map.omnimap", "filler", "interrupted"}));
  EXPECT_EQ(filesIn(folder + "/interrupted").count("trajectory.tum"), 1U) << "outputs that fit must be written";
}

TEST_F(OutputFolder, ADiskThatIsFullAlreadyIsFoundBeforeTheLogIsMapped) {
  const std::string folder = scratch_ / "disk";
  const SmallDisk disk(folder, "1m");
  if (!disk.mounted()) GTEST_SKIP() << "mounting a small disk is not permitted; FilesThatMayNotGrow... has run";
  writeFile(folder + "/filler", std::string(1'000'000, 'x'));
  EXPECT_TRUE(endedWith(ExitCode::disk_full, map({log_path_}, folder), {folder, "no room for outputs", "Free some"}));
  EXPECT_EQ(filesIn(folder), std::set<std::string>{"filler"});
}

TEST_F(OutputFolder, FilesThatMayNotGrowKeepTheOldMapAndTheOtherOutputsAreWrittenElsewhere) {
  const std::string folder = scratch_ / "map";
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder)));
  const auto before = contentsOf(folder);
  ProgramOptions limited;
  limited.largest_file = before.at("map.omnimap").size() / 2;
  EXPECT_TRUE(endedWith(ExitCode::disk_full, map({log_path_}, folder, {}, limited),
                        {folder + "/map.omnimap: cannot be written", "is unchanged", "Free some room"}));
  EXPECT_EQ(contentsOf(folder), before);
  auto written = allOutputs();
  written.erase("map.omnimap");
  for (const auto& name : filesIn(folder + "/interrupted")) EXPECT_EQ(written.count(name), 1U) << name;
  EXPECT_EQ(filesIn(folder + "/interrupted").count("trajectory.tum"), 1U);
}

TEST_F(OutputFolder, AnotherIniLeavesNoFileOfTheOneBefore) {
  const std::string folder = scratch_ / "map";
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder)));
  writeFile(folder + "/notes.txt", "mine");
  const auto ended = map({log_path_}, folder, {"--set", "mapper.output_plugins=trajectory"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("notes.txt"), std::string::npos) << ended.out;
  EXPECT_EQ(filesIn(folder), (std::set<std::string>{"trajectory.tum", "notes.txt"}));
}

TEST_F(OutputFolder, OfARunThatStillGoesOnIsRefusedToASecond) {
  const std::string folder = scratch_ / "map";
  omnimapper::testing::Program first(mappingCommand({log_path_}, folder, {"--speed", "0.001"}));
  while (!fs::exists(folder + "/.omnimapper/staged") && first.isRunning())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, map({log_path_}, folder), {folder, "another run"}));
  first.send(SIGKILL);
  first.wait();
  EXPECT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder))) << "the lock of a killed run does not count";
  EXPECT_EQ(filesIn(folder), allOutputs());
}

// Whenever a run is ended, and by whichever signal, the next program finds the outputs of one whole run in the folder.
TEST_F(OutputFolder, KilledAtAnyTimeHoldsOneWholeRun) {
  const std::string folder = scratch_ / "map";
  const Texts other{"--set", "grid.resolution_m=0.1"};
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, scratch_ / "new", other)));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder)));
  const auto stable = [](std::map<std::string, std::string> files) {
    files.erase("report.html");  // with summary.json the only outputs that contain times of the run
    files.erase("summary.json");
    return files;
  };
  const auto old_run = stable(contentsOf(folder)), new_run = stable(contentsOf(scratch_ / "new"));
  ASSERT_NE(old_run, new_run);
  for (int i = 0; i < 30; ++i) {
    omnimapper::testing::Program program(mappingCommand({log_path_}, folder, i % 2 == 0 ? other : Texts{}));
    std::this_thread::sleep_for(std::chrono::milliseconds(20 * i));
    program.send(std::array{SIGKILL, SIGINT, SIGTERM}[i % 3]);
    program.wait();
    loadMap(folder);  // as the next program does
    const auto files = stable(contentsOf(folder));
    EXPECT_TRUE(files == old_run || files == new_run) << "killed after " << 20 * i << " ms";
  }
}

}  // namespace

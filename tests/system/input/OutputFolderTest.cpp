// Where the outputs cannot be written: the exit code tells the cause, and what was there before stays whole.
#include <sys/mount.h>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

/// A disk of that size in a folder, for as long as the object lives.
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
  for (const std::string& folder : {file, file + "/below", std::string("/proc/self")}) {
    EXPECT_TRUE(endedWith(ExitCode::unwritable_output, map({log_path_}, folder), {folder, "permissions"}));
  }
  EXPECT_EQ(readFile(file), "a file");
}

TEST_F(OutputFolder, OnAFullDiskKeepsTheOldMapAndLeavesNoHalfFiles) {
  const std::string folder = scratch_ / "disk";
  const SmallDisk disk(folder, "1m");
  if (!disk.mounted()) GTEST_SKIP() << "may not mount a small disk; FilesThatMayNotGrow... has run";
  const std::string old_map = "the map of before";
  writeFile(folder + "/map.omnimap", old_map);
  writeFile(folder + "/filler", std::string(950'000, 'x'));
  EXPECT_TRUE(endedWith(ExitCode::disk_full, map({log_path_}, folder),
                        {folder, "No space left on device", "previous content is kept", "Free some room"}));
  EXPECT_EQ(readFile(folder + "/map.omnimap"), old_map);
  for (const auto& name : filesIn(folder)) EXPECT_EQ(name.find(".tmp"), std::string::npos) << name;
}

TEST_F(OutputFolder, FilesThatMayNotGrowKeepTheOldMapAndTheOtherOutputsAreWritten) {
  const std::string folder = scratch_ / "map";
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder)));
  const std::string old_map = readFile(folder + "/map.omnimap");
  fs::remove(folder + "/trajectory.tum");
  ProgramOptions limited;
  limited.largest_file = old_map.size() / 2;
  EXPECT_TRUE(endedWith(ExitCode::disk_full, map({log_path_}, folder, {}, limited),
                        {folder, "previous content is kept", "Free some room"}));
  EXPECT_EQ(filesIn(folder), allOutputs()) << "what fits is written";
  EXPECT_TRUE(readFile(folder + "/map.omnimap") == old_map);
}

}  // namespace

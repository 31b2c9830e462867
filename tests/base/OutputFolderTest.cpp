#include <gtest/gtest.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace omnimapper::base::output_folder_test {
namespace {

namespace fs = std::filesystem;
using testing::ScratchFolder;
using Contents = std::map<std::string, std::string>;

void put(const std::string& path, const std::string& bytes) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

void stage(const OutputFolder& folder, const Contents& files) {
  for (const auto& [name, bytes] : files) put(folder.staging() + "/" + name, bytes);
}

void write(const std::string& path, const Contents& files) {
  OutputFolder folder(path);
  folder.open();
  stage(folder, files);
  folder.commit();
}

// The files that a user sees in the folder, without those of the hidden folder.
Contents contents(const std::string& folder) {
  Contents files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto name = entry.path().lexically_relative(folder).string();
    if (entry.is_regular_file() && name.rfind(".omnimapper", 0) != 0) files[name] = readInput(entry.path());
  }
  return files;
}

ExitCode codeOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::ok;
}

const Contents kOld{{"map", "old"}, {"only_old", "1"}, {"pictures/a", "old a"}};
const Contents kNew{{"map", "new"}, {"only_new", "2"}, {"truth/b", "new b"}};

TEST(OutputFolder, ACommitReplacesAllFilesOfTheRunBefore) {
  ScratchFolder scratch;
  write(scratch / "out", kOld);
  EXPECT_EQ(contents(scratch / "out"), kOld);
  write(scratch / "out", kNew);
  EXPECT_EQ(contents(scratch / "out"), kNew);
  EXPECT_FALSE(fs::exists(scratch / "out/pictures"));
}

TEST(OutputFolder, WithoutACommitNothingChanges) {
  ScratchFolder scratch;
  write(scratch / "out", kOld);
  {
    OutputFolder folder(scratch / "out");
    folder.open();
    stage(folder, kNew);
  }
  EXPECT_EQ(contents(scratch / "out"), kOld);
  EXPECT_FALSE(fs::exists(scratch / "out/.omnimapper/staged"));
}

TEST(OutputFolder, AFolderThatARunMadeForNothingGoesAgain) {
  ScratchFolder scratch;
  { OutputFolder(scratch / "out").open(); }
  EXPECT_FALSE(fs::exists(scratch / "out"));
  put(scratch / "used/notes.txt", "mine");
  { OutputFolder(scratch / "used").open(); }
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "used"), {}), 1) << "no hidden folder is left either";
}

TEST(OutputFolder, WhatSomebodyElsePutThereStaysAndIsNamed) {
  ScratchFolder scratch;
  write(scratch / "out", {{"map", "old"}, {"truth/a", "1"}, {"truth.tum", "2"}, {"edited", "as written"}});
  put(scratch / "out/notes.txt", "mine");
  put(scratch / "out/truth/mine", "mine");
  put(scratch / "out/edited", "by hand, and longer");
  OutputFolder folder(scratch / "out");
  folder.open();
  stage(folder, {{"map", "new"}});
  folder.commit();
  EXPECT_EQ(
      contents(scratch / "out"),
      (Contents{{"map", "new"}, {"notes.txt", "mine"}, {"truth/mine", "mine"}, {"edited", "by hand, and longer"}}));
  EXPECT_EQ(folder.foreignFiles(), (std::vector<std::string>{"edited", "notes.txt", "truth"}));
}

TEST(OutputFolder, WhatHasTheNameOfANewFileIsKeptBesideIt) {
  ScratchFolder scratch;
  put(scratch / "out/map", "mine");
  put(scratch / "out/map~", "mine, older");
  write(scratch / "out", {{"map", "first"}});
  write(scratch / "out", {{"map", "second"}});
  EXPECT_EQ(contents(scratch / "out"), (Contents{{"map", "second"}, {"map~", "mine, older"}, {"map~2", "mine"}}));
}

TEST(OutputFolder, BesideAMapWithoutAListOutputsAreTakenForARuns) {
  ScratchFolder scratch;
  put(scratch / "out/map.omnimap", "copied");
  put(scratch / "out/map.png", "copied");
  write(scratch / "out", {{"map.omnimap", "new"}, {"map.png", "new"}});
  EXPECT_EQ(contents(scratch / "out"), (Contents{{"map.omnimap", "new"}, {"map.png", "new"}}));
}

TEST(OutputFolder, KilledAfterItsNoteWhatWasThereIsStillKeptBesideIt) {
  ScratchFolder scratch;
  for (const bool was_renamed : {false, true}) {
    const std::string path = scratch / (was_renamed ? "renamed" : "noted");
    put(path + "/map", "mine");
    put(path + "/.omnimapper/staged/map", "new");
    put(path + "/.omnimapper/commit", "files of a run of OmniMapper, 1\n3 map\n~ map\n");
    if (was_renamed) fs::rename(path + "/map", path + "/map~");
    { OutputFolder(path).open(); }
    EXPECT_EQ(contents(path), (Contents{{"map", "new"}, {"map~", "mine"}}));
    write(path, {{"map", "newer"}});
    EXPECT_EQ(contents(path), (Contents{{"map", "newer"}, {"map~", "mine"}}));
  }
}

TEST(OutputFolder, NamesMayHaveBlanksButNoLineBreaks) {
  ScratchFolder scratch;
  const Contents odd{{" a b ", "1"}, {"c/ d", "2"}};
  write(scratch / "out", odd);
  EXPECT_EQ(contents(scratch / "out"), odd);
  write(scratch / "out", kNew);
  EXPECT_EQ(contents(scratch / "out"), kNew);
  EXPECT_EQ(codeOf([&] { write(scratch / "out", {{"a\nb", "1"}}); }), ExitCode::unwritable_output);
  EXPECT_EQ(contents(scratch / "out"), kNew);
}

TEST(OutputFolder, WhatIsToBeKeptStaysUnlessItIsReplaced) {
  ScratchFolder scratch;
  for (const bool is_replaced : {false, true}) {
    const std::string path = scratch / (is_replaced ? "replaced" : "kept");
    write(path, kOld);
    OutputFolder folder(path);
    folder.open();
    folder.keep("map");
    folder.keep("not_there");
    stage(folder, is_replaced ? kNew : Contents{{"only_new", "2"}});
    folder.commit();
    EXPECT_EQ(contents(path), is_replaced ? kNew : (Contents{{"map", "old"}, {"only_new", "2"}}));
    EXPECT_TRUE(folder.foreignFiles().empty());
  }
}

TEST(OutputFolder, TwoRunsAtOnceAreRefused) {
  ScratchFolder scratch;
  OutputFolder first(scratch / "out");
  first.open();
  EXPECT_EQ(codeOf([&] { OutputFolder(scratch / "out").open(); }), ExitCode::unwritable_output);
  stage(first, kNew);
  first.commit();
  EXPECT_EQ(contents(scratch / "out"), kNew);
}

TEST(OutputFolder, AFullDiskAndAFolderInTheWayChangeNothing) {
  ScratchFolder scratch;
  write(scratch / "out", kOld);
  {
    OutputFolder folder(scratch / "out");
    folder.open();
    stage(folder, kNew);
    const testing::SmallFiles full(16);
    EXPECT_EQ(codeOf([&] { folder.commit(); }), ExitCode::disk_full);
  }
  EXPECT_EQ(contents(scratch / "out"), kOld);
  fs::create_directories(scratch / "out/only_new/inside");
  {
    OutputFolder folder(scratch / "out");
    folder.open();
    stage(folder, kNew);
    EXPECT_EQ(codeOf([&] { folder.commit(); }), ExitCode::unwritable_output);
  }
  EXPECT_EQ(contents(scratch / "out"), kOld);
}

// The obstacle is found before the commit, so that the run's files can still be moved elsewhere.
TEST(OutputFolder, WhatIsInTheWayOfAFolderIsFoundBeforeAnythingChanges) {
  ScratchFolder scratch;
  fs::create_directory(scratch / "elsewhere");
  for (const bool is_link : {false, true}) {
    const std::string path = scratch / (is_link ? "link" : "file");
    write(path, kOld);
    if (is_link) fs::create_directory_symlink(scratch / "elsewhere", path + "/truth");
    if (!is_link) put(path + "/truth", "mine");
    OutputFolder folder(path);
    folder.open();
    stage(folder, kNew);
    EXPECT_EQ(codeOf([&] { folder.commit(); }), ExitCode::unwritable_output);
    EXPECT_FALSE(folder.isCommitted());
    EXPECT_EQ(readInput(path + "/map"), "old");
    folder.commitInto("interrupted");
    EXPECT_EQ(readInput(path + "/interrupted/truth/b"), "new b");
  }
  EXPECT_TRUE(fs::is_empty(scratch / "elsewhere"));
}

// In an archive from another user, reading a file must not write or remove anything behind a link.
TEST(OutputFolder, AHostileNoteIsNotFollowedThroughALink) {
  ScratchFolder scratch;
  put(scratch / "home/.profile", "mine");
  put(scratch / "home/other", "mine");
  put(scratch / "out/map", "map");
  put(scratch / "out/.omnimapper/staged/sub/.profile", "theirs");
  put(scratch / "out/.omnimapper/commit", "files of a run of OmniMapper, 1\n6 sub/.profile\n");
  put(scratch / "out/.omnimapper/files", "files of a run of OmniMapper, 1\n4 sub/.profile\n4 sub/other\n");
  fs::create_directory_symlink(scratch / "home", scratch / "out/sub");
  EXPECT_EQ(readInput(scratch / "out/map"), "map");
  EXPECT_EQ(readInput(scratch / "home/.profile"), "mine");
  EXPECT_EQ(readInput(scratch / "home/other"), "mine");
}

TEST(OutputFolder, IsBeingWrittenUntilItIsReleased) {
  const testing::ScratchFolder scratch;
  const std::string path = scratch / "run";
  EXPECT_FALSE(isBeingWritten(path)) << "there is none";
  OutputFolder folder(path);
  folder.open();
  EXPECT_TRUE(isBeingWritten(path));
  stage(folder, kNew);
  folder.commit();
  folder.release();
  EXPECT_FALSE(isBeingWritten(path));
  write(path, kOld);  // another run
  EXPECT_EQ(contents(path), kOld);
}

TEST(OutputFolder, IsEmptiedOfWhatAKilledRunShowed) {
  const testing::ScratchFolder scratch;
  put(scratch / "run/.omnimapper/growing/checkpoint.omnimap", "of a killed run");
  {
    OutputFolder folder(scratch / "run");
    folder.open();
    EXPECT_TRUE(fs::is_empty(folder.growing()));
  }
  EXPECT_FALSE(fs::exists(scratch / "run/.omnimapper/growing"));
}

TEST(OutputFolder, AnInputIsNotReplaced) {
  ScratchFolder scratch;
  write(scratch / "out", kOld);
  const InputsKept kept({scratch / "out/map"});
  OutputFolder folder(scratch / "out");
  folder.open();
  stage(folder, kNew);
  EXPECT_EQ(codeOf([&] { folder.commit(); }), ExitCode::command_line);
  EXPECT_EQ(contents(scratch / "out"), kOld);
}

TEST(OutputFolder, AnInputThatNoNewFileReplacesStays) {
  ScratchFolder scratch;
  write(scratch / "out", kOld);
  const InputsKept kept({scratch / "out/only_old"});
  write(scratch / "out", kNew);
  auto expected = kNew;
  expected["only_old"] = "1";
  EXPECT_EQ(contents(scratch / "out"), expected);
}

TEST(OutputFolder, AnInnerFolderTakesWhatIsNotWholeAndGoesWithIt) {
  ScratchFolder scratch;
  write(scratch / "out", kOld);
  OutputFolder folder(scratch / "out");
  folder.open();
  stage(folder, kNew);
  folder.commitInto("interrupted");
  auto expected = kOld;
  for (const auto& [name, bytes] : kNew) expected["interrupted/" + name] = bytes;
  auto seen = contents(scratch / "out");
  for (auto it = seen.begin(); it != seen.end();)
    it = it->first.find(".omnimapper") != std::string::npos ? seen.erase(it) : std::next(it);
  EXPECT_EQ(seen, expected);
  EXPECT_TRUE(folder.foreignFiles().empty());
  folder.removeInner("interrupted");
  EXPECT_EQ(contents(scratch / "out"), kOld);
  EXPECT_FALSE(fs::exists(scratch / "out/interrupted"));
}

// A run that is killed while it moves its files leaves the record of the commit, and some files already moved.
class KilledCommit : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    folder_ = scratch_ / "out";
    write(folder_, kOld);
    // The record is copied from another folder with the same files.
    OutputFolder killed(folder_);
    killed.open();
    stage(killed, kNew);
    write(scratch_ / "other", kNew);
    for (const auto& [name, bytes] : kNew)
      fs::copy_file(scratch_ / "other/" + name, killed.staging() + "/" + name, fs::copy_options::overwrite_existing);
    fs::copy_file(scratch_ / "other/.omnimapper/files", folder_ + "/.omnimapper/commit");
    int moved = 0;
    for (const auto& [name, bytes] : kNew) {
      if (moved++ >= GetParam()) break;
      fs::create_directories(fs::path(folder_ + "/" + name).parent_path());
      fs::rename(killed.staging() + "/" + name, folder_ + "/" + name);
    }
  }
  ScratchFolder scratch_;
  std::string folder_;
};

TEST_P(KilledCommit, IsFinishedByWhoeverReadsAFile) {
  EXPECT_EQ(readInput(folder_ + "/map"), "new");
  EXPECT_EQ(contents(folder_), kNew);
}

TEST_P(KilledCommit, IsFinishedByWhoeverWritesIntoTheFolder) {
  { OutputFolder(folder_).open(); }
  EXPECT_EQ(contents(folder_), kNew);
}

INSTANTIATE_TEST_SUITE_P(AfterSoManyFiles, KilledCommit, ::testing::Values(0, 1, 2, 3));

TEST(OutputFolder, AListThatNamesPlacesOutsideRemovesNothingThere) {
  ScratchFolder scratch;
  put(scratch / "precious", "mine");
  write(scratch / "out", kOld);
  const auto size = fs::file_size(scratch / "precious");
  std::ofstream(scratch / "out/.omnimapper/files") << "files of a run of OmniMapper, 1\n"
                                                   << size << " ../precious\n"
                                                   << size << " " << scratch / "precious"
                                                   << "\nnonsense\n";
  write(scratch / "out", kNew);
  EXPECT_TRUE(fs::exists(scratch / "precious"));
}

// Whenever the process is killed, the next program sees either all old files or all new ones.
TEST(OutputFolder, KilledAtAnyTimeItIsWhollyOldOrWhollyNew) {
  ScratchFolder scratch;
  int old_ones = 0, new_ones = 0;
  for (int delay = 0; delay < 3000; delay += 60) {
    const std::string path = scratch / std::to_string(delay);
    write(path, kOld);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      write(path, kNew);
      _exit(0);
    }
    ::usleep(static_cast<unsigned>(delay));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    const bool is_new = readInput(path + "/map") == "new";
    EXPECT_EQ(contents(path), is_new ? kNew : kOld) << delay << " us";
    ++(is_new ? new_ones : old_ones);
  }
  RecordProperty("old", old_ones);
  RecordProperty("new", new_ones);
}

}  // namespace
}  // namespace omnimapper::base::output_folder_test

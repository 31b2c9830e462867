#include <gtest/gtest.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

namespace omnimapper::base::atomic_file_test {
namespace {

namespace fs = std::filesystem;
using testing::ScratchFolder;

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

int filesIn(const std::string& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void writeText(const std::string& path, const std::string& text) {
  writeFile(path, [&](std::ostream& out) { out << text; });
}

// Runs `check` in a child process, so that its limits and mounts end with it. Returns true if `check` returned true.
bool holdsInChild(const std::function<bool()>& check) {
  const pid_t child = ::fork();
  if (child == 0) {
    bool holds = false;
    try {
      holds = check();
    } catch (const std::exception&) {
    }
    ::_exit(holds ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Whether writing `text` is refused as disk_full, with the old content kept and no temporary file left.
bool failsWhole(const std::string& folder, const std::string& text) {
  const std::string path = folder + "/map.txt";
  writeText(path, "old");
  try {
    writeText(path, text);
    return false;
  } catch (const Error& error) {
    return error.code() == ExitCode::disk_full && std::string(error.what()).find(path) != std::string::npos &&
           contentOf(path) == "old" && filesIn(folder) == 1;
  }
}

TEST(AtomicFile, WritesAndReplaces) {
  ScratchFolder folder;
  const std::string path = folder / "a.txt";
  writeText(path, "one");
  EXPECT_EQ(contentOf(path), "one");
  writeText(path, "");
  EXPECT_EQ(contentOf(path), "");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, GivesTheWriterATemporaryNameInTheSameFolderWithTheSameExtension) {
  ScratchFolder folder;
  const std::string path = folder / "map.omap.gz";
  replaceFile(path, [&](const std::string& temporary) {
    EXPECT_NE(temporary, path);
    EXPECT_EQ(fs::path(temporary).parent_path(), folder.path());
    EXPECT_EQ(fs::path(temporary).extension(), ".gz");
    std::ofstream(temporary) << "x";
  });
  EXPECT_EQ(contentOf(path), "x");
}

TEST(AtomicFile, AWriterThatThrowsLeavesTheOldContentAndNoTemporaryFile) {
  ScratchFolder folder;
  const std::string path = folder / "a.txt";
  writeText(path, "old");
  const auto failing = [](std::ostream& out) {
    out << "half of the new";
    throw std::runtime_error("sensor on fire");
  };
  try {
    writeFile(path, failing);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::disk_full);
    EXPECT_NE(std::string(error.what()).find("sensor on fire"), std::string::npos);
  }
  EXPECT_EQ(contentOf(path), "old");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, AWriterThatWritesNothingAtAllIsAnError) {
  ScratchFolder folder;
  EXPECT_THROW(replaceFile(folder / "a.bin", [](const std::string&) {}), Error);
  EXPECT_EQ(filesIn(folder.path()), 0);
}

TEST(AtomicFile, AFailedStreamIsAFailedWrite) {
  ScratchFolder folder;
  EXPECT_THROW(writeFile(folder / "a.txt", [](std::ostream& out) { out.setstate(std::ios::badbit); }), Error);
  EXPECT_EQ(filesIn(folder.path()), 0);
}

TEST(AtomicFile, AnyMomentOfKillLeavesOneWholeVersion) {
  ScratchFolder folder;
  const std::string path = folder / "map.bin";
  constexpr std::size_t kSize = 300'000;
  writeText(path, std::string(kSize, 'a'));
  std::mt19937 random(9);
  std::uniform_int_distribution<int> microseconds(0, 25'000);
  for (int round = 0; round < 40; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int version = 0;; ++version) writeText(path, std::string(kSize, static_cast<char>('a' + version % 26)));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random)));
    const std::string while_writing = contentOf(path);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    for (const std::string& content : {while_writing, contentOf(path)}) {
      ASSERT_EQ(content.size(), kSize);
      ASSERT_EQ(content.find_first_not_of(content[0]), std::string::npos);
    }
  }
}

TEST(AtomicFile, WhatKilledWritersLeftIsRemovedAndNothingElse) {
  ScratchFolder folder;
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ::waitpid(gone, nullptr, 0);
  const std::string dead = std::to_string(gone), alive = std::to_string(::getppid());
  const std::vector<std::string> kept{"map.tmp" + alive + ".omnimap", "map.tmp.omnimap", "map.tmp" + dead + ".png",
                                      "map.tmp" + dead + "b.omnimap", "amap.tmp" + dead + ".omnimap"};
  for (const auto& name : kept) std::ofstream(folder / name) << "x";
  std::ofstream(folder / ("map.tmp" + dead + ".omnimap")) << "half a map";
  writeText(folder / "map.omnimap", "whole");
  EXPECT_FALSE(fs::exists(folder / ("map.tmp" + dead + ".omnimap")));
  for (const auto& name : kept) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(AtomicFile, ALinkOfTheTemporaryNameIsNotWrittenThrough) {
  ScratchFolder folder;
  writeText(folder / "precious.txt", "precious");
  fs::create_symlink(folder / "precious.txt", folder / ("map.tmp" + std::to_string(::getpid()) + ".txt"));
  writeText(folder / "map.txt", "new");
  EXPECT_EQ(contentOf(folder / "precious.txt"), "precious");
  EXPECT_EQ(contentOf(folder / "map.txt"), "new");
  EXPECT_FALSE(fs::is_symlink(folder / "map.txt"));
}

TEST(AtomicFile, AnInputIsKeptWhileItIsRead) {
  ScratchFolder folder;
  writeText(folder / "log.txt", "log");
  {
    const InputsKept kept({folder / "log.txt"});
    EXPECT_THROW(writeText(folder / "log.txt", "new"), Error);
    writeText(folder / "other.txt", "new");
  }
  EXPECT_EQ(contentOf(folder / "log.txt"), "log");
  writeText(folder / "log.txt", "new");
  EXPECT_EQ(contentOf(folder / "log.txt"), "new");
}

TEST(AtomicFile, AFileThatCannotGrowKeepsItsOldContent) {
  ScratchFolder folder;
  EXPECT_TRUE(holdsInChild([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20'000, 20'000};
    return ::setrlimit(RLIMIT_FSIZE, &limit) == 0 && failsWhole(folder.path(), std::string(200'000, 'n'));
  }));
}

TEST(AtomicFile, AFullDiskKeepsTheOldContent) {
  ScratchFolder folder;
  const auto mounted = [&] {
    return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           ::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=64k") == 0;
  };
  if (!holdsInChild(mounted)) GTEST_SKIP() << "may not mount a small disk; AFileThatCannotGrow... has run";
  EXPECT_TRUE(holdsInChild([&] { return mounted() && failsWhole(folder.path(), std::string(500'000, 'n')); }));
}

TEST(AtomicFile, AnInputIsNotReplacedByWhateverName) {
  const ScratchFolder scratch;
  writeText(scratch / "in", "text");
  fs::create_symlink(scratch / "in", scratch / "link");
  const std::string other_path = scratch / "./in";
  for (const auto& output : {scratch / "in", scratch / "link", other_path}) {
    try {
      refuseToReplaceInput(output, {scratch / "none", scratch / "in"});
      ADD_FAILURE() << output;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::command_line);
      EXPECT_NE(std::string(error.what()).find(output), std::string::npos) << error.what();
    }
  }
  EXPECT_NO_THROW(refuseToReplaceInput(scratch / "out", {scratch / "in"}));
  writeText(scratch / "out", "text");
  EXPECT_NO_THROW(refuseToReplaceInput(scratch / "out", {scratch / "in"}));
}

TEST(AtomicFile, MakesFoldersWithTheirParents) {
  ScratchFolder folder;
  makeWritableFolder(folder / "a/b/c");
  makeWritableFolder(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  EXPECT_EQ(filesIn(folder / "a/b/c"), 0);
}

TEST(AtomicFile, AFolderThatCannotBeMadeOrWrittenIsRefusedByName) {
  ScratchFolder folder;
  writeText(folder / "file", "x");
  // Even root cannot write below a file or into /proc.
  for (const std::string& path : {folder / "file", folder / "file/below", std::string("/proc/self")}) {
    try {
      makeWritableFolder(path);
      FAIL() << path << " was taken for a writable folder";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::unwritable_output);
      EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
    }
  }
}

TEST(AtomicFile, WritingIntoAFolderThatIsNotThereIsAnError) {
  ScratchFolder folder;
  const std::string path = folder / "missing/a.txt";
  try {
    writeText(path, "x");
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unwritable_output);
    EXPECT_EQ(std::string(error.what()).find(path), 0U) << error.what();
    EXPECT_EQ(std::string(error.what()).find("room"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder / "missing"));
}

}  // namespace
}  // namespace omnimapper::base::atomic_file_test

#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

namespace omnimapper::source::rawlog_writer_test {
namespace {

using namespace logs;

void fillBothFormats(RawlogWriter& rawlog) {
  mrpt::obs::CActionCollection actions;
  mrpt::obs::CSensoryFrame frame;
  frame.insert(scan(1));
  rawlog.add(actions, frame);
  rawlog.add(*odometry(2));
}

TEST(RawlogWriter, writesWhatRawlogSourceReads) {
  const testing::ScratchFolder folder;
  writeRawlog(folder / "x.rawlog", fillBothFormats);
  RawlogSource source(folder / "x.rawlog");
  EXPECT_EQ(listing(readAll(source)), (std::vector<std::string>{"laser 1", "wheels 2"}));
  EXPECT_EQ(source.report().ending, SourceReport::Ending::complete);
}

TEST(RawlogWriter, sameContentGivesTheSameBytes) {
  const testing::ScratchFolder folder;
  writeRawlog(folder / "x.rawlog", fillBothFormats);
  writeRawlog(folder / "y.rawlog", fillBothFormats);
  EXPECT_EQ(readFile(folder / "x.rawlog"), readFile(folder / "y.rawlog"));
}

TEST(RawlogWriter, failedWritingKeepsTheOldFileAndLeavesNoOther) {
  const testing::ScratchFolder folder;
  const auto path = writePlain(folder / "x.rawlog", "old");
  const auto failing = [](RawlogWriter& rawlog) {
    rawlog.add(*odometry(1));
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(writeRawlog(path, failing), base::Error);
  EXPECT_EQ(readFile(path), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

// A limit on the size of files stands in for a full disk: in both cases write() takes less than it is given.
TEST(RawlogWriter, fullDiskIsNoticedEvenForASmallFile) {
  const testing::ScratchFolder folder;
  const auto path = writePlain(folder / "x.rawlog", "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{100, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  base::ExitCode code = base::ExitCode::ok;
  try {
    writeRawlog(path, fillBothFormats);
  } catch (const base::Error& error) {
    code = error.code();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(code, base::ExitCode::disk_full);
  EXPECT_EQ(readFile(path), "old");
}

TEST(RawlogWriter, folderThatDoesNotExistIsNamed) {
  const testing::ScratchFolder folder;
  try {
    writeRawlog(folder / "no/x.rawlog", fillBothFormats);
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("no/x.rawlog"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::source::rawlog_writer_test

#include <omnimapper/base/Error.h>
#include <omnimapper/source/LogLook.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

#include <filesystem>

namespace omnimapper::source::log_look_test {
namespace {

class LogLookTest : public ::testing::Test {
 protected:
  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "log";
};

TEST_F(LogLookTest, theHeadOfAFileIsUncompressedAndBounded) {
  const std::string text = "ODOM 1 2 3\n";
  for (const auto& path :
       {logs::writePlain(path_, text), logs::writeGzip(path_ + ".gz", text), logs::writeBzip2(path_ + ".bz2", text)}) {
    const auto look = LogLook::at(path);
    EXPECT_EQ(look.head, text) << path;
    EXPECT_TRUE(!look.is_folder && look.isText() && look.headBeginsWith("ODOM") && !look.headBeginsWith("ODOM 2"));
  }
  EXPECT_EQ(LogLook::at(logs::writePlain(path_, std::string(100'000, 'x'))).head.size(), LogLook::kLongestHead);
}

TEST_F(LogLookTest, bytesThatAreNoLettersAreNoText) {
  EXPECT_FALSE(LogLook::at(logs::writePlain(path_, std::string("ODOM\0", 5))).isText());
  EXPECT_TRUE(LogLook::at(logs::writePlain(path_,
                                           "Stra\xc3\x9f"
                                           "e\t1\r\n"))
                  .isText());
}

TEST_F(LogLookTest, aFolderHasItsNamesSorted) {
  std::filesystem::create_directories(folder_ / "images/inner");
  for (const char* name : {"images/b.png", "images/a.png", "images/a.txt"}) logs::writePlain(folder_ / name, "");
  const auto look = LogLook::at(folder_ / "images");
  EXPECT_EQ(look.entries, (std::vector<std::string>{"a.png", "a.txt", "b.png", "inner"}));
  EXPECT_TRUE(look.is_folder && look.has("inner") && !look.has("b"));
  EXPECT_EQ(look.firstEnding(".png"), "a.png");
  EXPECT_EQ(look.firstEnding(".pcd"), "");
}

TEST_F(LogLookTest, whatIsNotThereOrIsEmptyIsAnErrorWithItsPath) {
  for (const auto& path : {folder_ / "none", logs::writePlain(path_, "")}) {
    try {
      LogLook::at(path);
      ADD_FAILURE() << path;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
}

TEST_F(LogLookTest, damagedCompressionIsNamed) {
  const auto look = LogLook::at(logs::writePlain(path_, "\x1f\x8b and no more gzip than that"));
  EXPECT_TRUE(look.head.empty());
  EXPECT_NE(look.problem, "");
}

}  // namespace
}  // namespace omnimapper::source::log_look_test

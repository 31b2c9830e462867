#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/ImportApp.h>
#include <omnimapper/testing/Logs.h>

#include <cstdlib>
#include <filesystem>

namespace omnimapper::source::import_carmen_test {
namespace {

using base::ExitCode;

class ImportCarmenTest : public ImportApp {
 protected:
  testing::ScratchFolder folder_;
  std::string in_ = folder_ / "x.clf", out_ = folder_ / "x.rawlog";
  const std::string log_ =
      "ODOM 1 0 0 0 0 0 10.4 h 0\nFLASER 3 1 2 3 1 0 0 1 0 0 10.5 h 0\nODOM 2 0 0 0 0 0 10.6 h 0\n";
};

TEST_F(ImportCarmenTest, writesARawlogAndSaysWhatIsInIt) {
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok) << output_;
  EXPECT_TRUE(says("FLASER") && says("ODOM") && says("10.500000") && says("complete")) << output_;
  RawlogSource source(out_);
  EXPECT_EQ(logs::readAll(source).size(), 4u) << "two of ODOM lines, a scan, its own odometry";
}

TEST_F(ImportCarmenTest, writtenRawlogIsReadByRawlogEdit) {
  logs::writePlain(in_, log_);
  ASSERT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok);
  if (std::system("command -v rawlog-edit >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "rawlog-edit (Debian package mrpt-apps) is not installed";
  EXPECT_EQ(runCommand("rawlog-edit --info -i '" + out_ + "'"), ExitCode::ok);
  EXPECT_TRUE(says("FLASER, FLASER_ODOM, ODOM")) << output_;
}

TEST_F(ImportCarmenTest, truncatedLogGivesWhatIsReadableAndExitCode9) {
  logs::writePlain(in_, log_ + "FLASER 3 1 2");
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::damaged_input);
  EXPECT_TRUE(says("line 4 left out")) << output_;
  RawlogSource source(out_);
  EXPECT_EQ(logs::readAll(source).size(), 4u) << "two of ODOM lines, a scan, its own odometry";
}

TEST_F(ImportCarmenTest, exitCodesShowWhatWentWrong) {
  EXPECT_EQ(run("--help"), ExitCode::ok);
  EXPECT_TRUE(says("Example: omnimapper-import carmen")) << output_;
  EXPECT_EQ(run(""), ExitCode::command_line);
  EXPECT_TRUE(says("the first argument is one of carmen")) << output_;
  EXPECT_EQ(run("tmu a b"), ExitCode::command_line);
  EXPECT_TRUE(says("there is no task 'tmu'; did you mean tum?")) << output_;
  EXPECT_EQ(run("carmen " + in_), ExitCode::command_line);
  EXPECT_EQ(run("carmen a b --odometry wheels"), ExitCode::command_line);
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::unreadable_input);
  EXPECT_TRUE(says(in_ + ": No such file")) << output_;
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("carmen " + in_ + " " + folder_.path() + "/no/x.rawlog"), ExitCode::unwritable_output);
}

TEST_F(ImportCarmenTest, inputOfAnotherTaskIsRefusedWithItsName) {
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("tum " + in_ + " " + out_), ExitCode::unreadable_input);
  EXPECT_TRUE(says("is no folder: it is a CARMEN log")) << output_;
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok);
  EXPECT_EQ(run("carmen " + out_ + " " + in_), ExitCode::unreadable_input);
  EXPECT_TRUE(says("it is a rawlog, or")) << output_;
  EXPECT_EQ(run("pcd " + out_ + " " + in_), ExitCode::unreadable_input);
  EXPECT_TRUE(says("is no folder: it is a rawlog, or")) << output_;
}

TEST_F(ImportCarmenTest, aLogOfNothingLeavesWhatIsThere) {
  logs::writePlain(in_, "ODOM 1 2\nFLASER 3 1 2\n");
  logs::writePlain(out_, "an older log");
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::unreadable_input) << output_;
  EXPECT_TRUE(says(in_) && says("nothing was written")) << output_;
  EXPECT_EQ(std::filesystem::file_size(out_), 12U);
}

}  // namespace
}  // namespace omnimapper::source::import_carmen_test

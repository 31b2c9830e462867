#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>

#include "Logs.h"

namespace omnimapper::source {
namespace {

using base::ExitCode;

// Runs omnimapper-import; output_ is what it says.
class ImportAppTest : public ::testing::Test {
 protected:
  ExitCode run(const std::string& arguments) { return runCommand("'" OMNIMAPPER_IMPORT "' " + arguments); }
  ExitCode runCommand(const std::string& command) {
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    output_.clear();
    char buffer[4096];
    for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output_.append(buffer, n);
    return static_cast<ExitCode>(WEXITSTATUS(::pclose(pipe)));
  }
  bool says(const std::string& text) const { return output_.find(text) != std::string::npos; }

  testing::ScratchFolder folder_;
  std::string output_;
  std::string in_ = folder_ / "x.clf", out_ = folder_ / "x.rawlog";
  const std::string log_ =
      "ODOM 1 0 0 0 0 0 10.4 h 0\nFLASER 3 1 2 3 1 0 0 1 0 0 10.5 h 0\nODOM 2 0 0 0 0 0 10.6 h 0\n";
};

TEST_F(ImportAppTest, writesARawlogAndSaysWhatIsInIt) {
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok) << output_;
  EXPECT_TRUE(says("FLASER") && says("ODOM") && says("10.500000") && says("complete")) << output_;
  RawlogSource source(out_);
  EXPECT_EQ(logs::readAll(source).size(), 4u) << "two of ODOM lines, a scan, its own odometry";
}

TEST_F(ImportAppTest, writtenRawlogIsReadByRawlogEdit) {
  logs::writePlain(in_, log_);
  ASSERT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok);
  if (std::system("command -v rawlog-edit >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "rawlog-edit (Debian package mrpt-apps) is not installed";
  EXPECT_EQ(runCommand("rawlog-edit --info -i '" + out_ + "'"), ExitCode::ok);
  EXPECT_TRUE(says("FLASER, FLASER_ODOM, ODOM")) << output_;
}

TEST_F(ImportAppTest, truncatedLogGivesWhatIsReadableAndExitCode9) {
  logs::writePlain(in_, log_ + "FLASER 3 1 2");
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::damaged_input);
  EXPECT_TRUE(says("line 4 left out")) << output_;
  RawlogSource source(out_);
  EXPECT_EQ(logs::readAll(source).size(), 4u) << "two of ODOM lines, a scan, its own odometry";
}

TEST_F(ImportAppTest, exitCodesTellWhatWentWrong) {
  EXPECT_EQ(run("--help"), ExitCode::ok);
  EXPECT_TRUE(says("Example: omnimapper-import carmen")) << output_;
  EXPECT_EQ(run(""), ExitCode::command_line);
  EXPECT_EQ(run("carmen " + in_), ExitCode::command_line);
  EXPECT_EQ(run("carmen a b --odometry wheels"), ExitCode::command_line);
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::unreadable_input);
  EXPECT_TRUE(says(in_ + ": No such file")) << output_;
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("carmen " + in_ + " " + folder_.path() + "/no/x.rawlog"), ExitCode::disk_full);
}

}  // namespace
}  // namespace omnimapper::source

// omnimapper-calibrate mounting: from a log to an INI that the mapper reads.
#include <gtest/gtest.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>

namespace omnimapper::calibration::mounting_program_test {
namespace {

using testing::runProgram;
using testing::toString;

const std::string program = testing::ownProgram("omnimapper-calibrate");
const std::string log = testing::sourceFile("rawlogs/home_30s/home_30s.rawlog");

// The log declares its camera right, so an INI declares it wrong: turned by 5 deg, 15 cm too high, in other units, with
// a clock that is 0.5 s off.
const std::string declared =
    "[mapper]\npose_plugins = scan_odometry, odometry, no_motion\nsensors = camera\n"
    "[camera]\nlabel = kinect\npose_x_m = 0.2\npose_z_m = 1.25\npose_yaw_deg = 5\npose_pitch_deg = 10\n"
    "clock_offset_s = 0.5\n"
    "[calibration]\nlabel = kinect\ndepth_scale = 1.2\n";

double valueOf(const base::Config& config, const std::string& section, const std::string& key) {
  std::string text;
  return config.section(section).find(key, text) ? std::stod(text) : std::nan("");
}

TEST(MountingProgram, WritesWhatTheMapperHasToKnow) {
  const testing::ScratchFolder folder;
  const std::string wrong = folder / "wrong.ini", out = folder / "out", ini = out + "/mounting.ini";
  std::ofstream(wrong) << declared;
  const auto run = runProgram({program, "mounting", log, "-i", wrong, "-o", out});
  EXPECT_EQ(run.code, 0) << toString(run);
  EXPECT_NE(run.out.find("'kinect'       yaw                   5.00 deg"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("next: omnimapper-graphslam"), std::string::npos) << run.out;
  const auto config = base::Config::fromFile(ini);
  EXPECT_NEAR(valueOf(config, "camera", "pose_yaw_deg"), 0, 0.6) << run.out;
  EXPECT_NEAR(valueOf(config, "camera", "pose_z_m"), 1.1, 0.02);
  EXPECT_NEAR(valueOf(config, "camera", "clock_offset_s"), 0, 0.04);
  EXPECT_NEAR(valueOf(config, "calibration", "depth_scale"), 1, 0.02);

  // After mounting.ini the same INI declares nothing wrong.
  const auto again = runProgram({program, "mounting", log, "-i", wrong, "-i", ini, "-o", folder / "again"});
  EXPECT_EQ(again.code, 0) << toString(again);
  EXPECT_EQ(again.out.find("CORRECTED"), std::string::npos) << again.out;
  const auto checked =
      runProgram({testing::ownProgram("omnimapper-graphslam"), "--check", log, "-i", wrong, "-i", ini});
  EXPECT_EQ(checked.code, 0) << toString(checked);
}

TEST(MountingProgram, SaysWhatIsMissing) {
  const testing::ScratchFolder folder;
  const auto help = runProgram({program, "mounting", "--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("Example: omnimapper-calibrate mounting"), std::string::npos) << help.out;
  EXPECT_EQ(runProgram({program, "mounting", log}).code, 2) << "no folder";
  const auto missing = runProgram({program, "mounting", folder / "none.rawlog", "-o", folder / "out"});
  EXPECT_EQ(missing.code, 8) << toString(missing);
}

}  // namespace
}  // namespace omnimapper::calibration::mounting_program_test

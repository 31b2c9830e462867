// omnimapper-simulate: values of options that make no sense, alone or together.
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "SimulateRun.h"

namespace {

using namespace runs;

class SimulateValues : public ::testing::Test {
 protected:
  SimulateValues() { writeFile(ini_, kSmallWorld); }
  Ended with(const Texts& settings, const Texts& more = {}) {
    Texts words{"-i", ini_, "-o", folder_};
    for (const auto& setting : settings) words.insert(words.end(), {"--set", setting});
    words.insert(words.end(), more.begin(), more.end());
    return simulate(words);
  }

  omnimapper::testing::ScratchFolder scratch_;
  const std::string ini_ = scratch_ / "small.ini", folder_ = scratch_ / "out";
};

TEST_F(SimulateValues, AreRefusedWithTheirPlaceInTheIni) {
  struct Case {
    Texts settings, words;
  };
  const std::vector<Case> cases{
      {{"robot.waypoints=1 1, 2 2 nan"}, {"[robot]", "waypoints", "2 2 nan"}},
      {{"robot.waypoints=1 1, inf 2"}, {"[robot]", "waypoints", "inf 2"}},
      {{"robot.waypoints=,"}, {"[robot]", "waypoints", "names no place"}},
      {{"robot.mode=still", "robot.start=", "robot.waypoints= , "}, {"[robot]", "waypoints"}},
      {{"robot.mode=still", "robot.start=", "robot.waypoints=1 1, 2 1"}, {"[robot]", "waypoints", "more than one"}},
      {{"robot.start=1 1, 2 1"}, {"[robot]", "start", "more than one"}},
      {{"robot.repeat=10000", "robot.pause_s=3600"}, {"[robot]", "duration_s", "21600"}},
      {{"simulation.duration_s=1e9"}, {"[simulation]", "duration_s"}},
      {{"laser.rate_hz=1e9"}, {"[laser]", "rate_hz"}},
      {{"laser.rate_hz=1e5", "simulation.duration_s=1000"}, {"[laser]", "rate_hz", "measurements"}},
      {{"laser.label=front/laser"}, {"[laser]", "label", "front/laser"}},
      {{"camera.label=../camera"}, {"[camera]", "label"}},
      {{"laser.min_range_m=30"}, {"[laser]", "min_range_m", "max_range_m"}},
      {{"camera.signal_floor=-0.5"}, {"[camera]", "signal_floor", "-1"}},
      {{"camera.colour_right_m=-500"}, {"[camera]", "colour_right_m"}},
      {{"camera.model=stereo", "camera.colour_focal_px=100"}, {"[camera]", "colour_focal_px", "stereo"}},
      {{"camera.min_range_m=9", "camera.max_range_m=3"}, {"[camera]", "min_range_m", "max_range_m"}},
      {{"simulation.format=frames", "simulation.sensors=laser, camera"}, {"[simulation]", "format", "Odometry"}},
      {{"world.sign_style=whit"}, {"[world]", "sign_style", "white"}},
  };
  for (const auto& [settings, words] : cases) {
    const auto ended = with(settings);
    const bool is_type = settings.front() == "world.sign_style=whit";
    EXPECT_TRUE(endedWith(is_type ? ExitCode::wrong_type : ExitCode::out_of_range, ended, words)) << settings.front();
    EXPECT_FALSE(fs::exists(folder_)) << settings.front();
  }
}

TEST_F(SimulateValues, NamesOfLogsAreNoPaths) {
  EXPECT_TRUE(endedWith(ExitCode::command_line, with({}, {"--name", "../log"}), {"--name ../log"}));
  EXPECT_FALSE(fs::exists(scratch_ / "log.rawlog"));
}

TEST_F(SimulateValues, ASensorThatMeasuresNothingIsReported) {
  EXPECT_TRUE(endedWith(ExitCode::ok, with({"laser.first_s=60", "simulation.sensors=laser, odometry"}),
                        {"warning", "[laser]", "first_s"}));
}

TEST_F(SimulateValues, APrintedSectionKeepsTheModelItIsGiven) {
  std::string section = simulate({"--print-ini", "Laser2d"}).out;
  const std::string was = "model = sick_lms291";
  ASSERT_NE(section.find(was), std::string::npos) << section;
  section.replace(section.find(was), was.size(), "model = hokuyo_utm30");
  const std::string head = "[laser2d]";
  section.replace(section.find(head), head.size(), "[scanner]");
  writeFile(scratch_ / "scanner.ini", section);
  ASSERT_TRUE(endedWith(ExitCode::ok, simulate({"-i", ini_, "-i", scratch_ / "scanner.ini", "-o", folder_, "--set",
                                                "simulation.sensors=scanner", "--set", "simulation.duration_s=1"})));
  int scans = 0;
  readLog(folder_ + "/small.rawlog", [&](const mrpt::obs::CObservation& observation) {
    if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) {
      EXPECT_EQ(scan->getScanSize(), 1081U);
      ++scans;
    }
  });
  EXPECT_GT(scans, 0);
}

}  // namespace

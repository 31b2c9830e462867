// The verdict of a run on its own map.
#include <omnimapper/testing/SimulatedLog.h>

#include <nlohmann/json.hpp>

#include "../Runs.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLog;
using omnimapper::testing::SimulatedLogOptions;

class Verdict : public ::testing::Test {
 protected:
  /// Two laps. With the wheels alone the second one is rotated by half a radian.
  Verdict() {
    SimulatedLogOptions options;
    options.laps = 2;
    options.yaw_drift_per_m = 0.02;
    SimulatedLog(options).writeRawlog(log_);
  }

  std::string verdict() const {
    return nlohmann::json::parse(readFile(folder_ + "/summary.json")).at("verdict").at("verdict");
  }

  ScratchFolder scratch_;
  std::string log_ = scratch_ / "log.rawlog", folder_ = scratch_ / "map";
  // Neither laser odometry nor closures, so the map is as distorted as the odometry of the wheels.
  Texts wheels_alone_{"--set", "mapper.pose_plugins=odometry",   "--set", "odometry.fallback=false",
                      "--set", "loop_closure.min_travel_m=10000"};
};

TEST_F(Verdict, OnAGoodMapIsConsistent) {
  const auto ended = map({log_}, folder_, {"--strict"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_EQ(verdict(), "consistent");
  EXPECT_NE(ended.out.find("The map is consistent: no scan looks through walls"), std::string::npos) << ended.out;
}

TEST_F(Verdict, OnADistortedMapIsSuspiciousAndAWarning) {
  EXPECT_TRUE(endedWith(ExitCode::ok, map({log_}, folder_, wheels_alone_),
                        {"warning: The map is suspicious", "pass through walls of the map", "s after the start"}));
  EXPECT_EQ(verdict(), "suspicious");
  EXPECT_NE(readFile(folder_ + "/report.html").find("Verdict: suspicious"), std::string::npos);
}

TEST_F(Verdict, OnADistortedMapIsAnExitCodeWithStrict) {
  Texts strict = wheels_alone_;
  strict.insert(strict.end(), {"--strict", "-q"});
  EXPECT_TRUE(endedWith(ExitCode::suspicious_map, map({log_}, folder_, strict), {"The map is suspicious"}));
  EXPECT_EQ(filesIn(folder_), allOutputs()) << "the map must be written nevertheless";
}

}  // namespace

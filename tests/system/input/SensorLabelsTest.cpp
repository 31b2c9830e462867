// A label in the INI that no observation of the log has is reported, together with the existing labels.
#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

class SensorLabels : public ::testing::Test {
 protected:
  SensorLabels() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    options.laps = 0.5;
    SimulatedLog(options).writeRawlog(scratch_ / "box.rawlog");
  }
  Ended mapWith(const Texts& settings) {
    Texts more;
    for (const auto& setting : settings) more.insert(more.end(), {"--set", setting});
    return map({scratch_ / "box.rawlog"}, scratch_ / "map", more);
  }

  ScratchFolder scratch_;
};

TEST_F(SensorLabels, ThatTheLogHasNeedNoWord) {
  const auto ended = mapWith({"odometry.label=odometry", "loop_closure.labels=laser.points",
                              "mapper.reference_sensor=laser", "source.labels=laser, odometry"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_EQ(ended.err, "");
}

TEST_F(SensorLabels, ThatNothingHasAreNamedWithTheNearestAndAll) {
  EXPECT_TRUE(endedWith(ExitCode::ok, mapWith({"odometry.label=odometri"}),
                        {"warning: [odometry] label", "'odometri'", "did you mean 'odometry'?",
                         "Existing labels: laser, laser.points, odometry"}));
  EXPECT_TRUE(endedWith(ExitCode::ok, mapWith({"loop_closure.labels=laser", "scan_odometry.label=odometry"}),
                        {"nothing was measured"}))
      << "the points have another label than the laser";
  EXPECT_TRUE(endedWith(ExitCode::ok, mapWith({"loop_closure.labels=lasr.points, laser.points"}),
                        {"[loop_closure] labels", "'lasr.points'", "'laser.points'?"}));
  EXPECT_TRUE(endedWith(ExitCode::ok, mapWith({"mapper.sensors=front", "front.label=Laser"}), {"[front] label"}));
}

TEST_F(SensorLabels, OfAPluginThatGetsNothingAreReportedByItsName) {
  const auto ended =
      mapWith({"mapper.measurement_plugins=loop_closure, beacons", "beacons.class=PointLandmarksPlugin"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended, {"warning: [beacons] had nothing to work on", "--check LOG"}));
  EXPECT_EQ(ended.err.find("[loop_closure]"), std::string::npos) << ended.err;
}

TEST_F(SensorLabels, ThatTheSourceLeavesOutAreThereForIt) {
  EXPECT_TRUE(endedWith(ExitCode::nothing_to_map, mapWith({"source.labels=lasr, odometry"}),
                        {"[source] labels", "'lasr'", "did you mean 'laser'?", "Existing labels: laser, odometry"}));
}

TEST_F(SensorLabels, OfTheReferenceMustExist) {
  EXPECT_TRUE(endedWith(ExitCode::ok, mapWith({"mapper.reference_sensor=lidar"}), {"[mapper] reference_sensor"}));
}

}  // namespace

// How sensors are mounted is measured from logs whose truth is known.
#include <omnimapper/base/Error.h>
#include <omnimapper/check/MountingRun.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/DeclaredFaults.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

#include "CheckedLog.h"
#include "mounting/MountingIni.h"
#include "mounting/SensorMounting.h"

namespace omnimapper::check::mounting_run_test {
namespace {

using testing::DeclaredFault;
using testing::withFault;
using State = Quantity::State;

/// Half a minute of the simulated home. Its camera is at x 0.2 m, z 1.1 m and looks 10 deg down.
const Observations& home() {
  static const auto log = [] {
    Observations all;
    const auto source = source::openLogs({testing::sourceFile("rawlogs/home_30s/home_30s.rawlog")}, {});
    while (auto observation = source->next()) all.push_back(std::move(observation));
    return all;
  }();
  return log;
}

class MountingRunTest : public ::testing::Test {
 protected:
  MountingResult run(const Observations& log, const base::Config& config = base::Config::fromFiles({})) {
    source::writeRawlog(folder_ / "drive.rawlog", [&](source::RawlogWriter& writer) {
      for (const auto& observation : log) writer.add(*observation);
    });
    base::Progress progress;
    return runMounting({folder_ / "drive.rawlog"}, config, folder_ / "out", progress, [] { return false; });
  }
  std::string ini() const {
    std::ifstream in(folder_ / "out/mounting.ini");
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// A number of mounting.ini; NaN if it is not there, or only in a comment.
  double value(const std::string& section, const std::string& key) const {
    std::string text;
    const auto config = base::Config::fromFile(folder_ / "out/mounting.ini");
    return config.section(section).find(key, text) ? std::stod(text) : std::nan("");
  }

  testing::ScratchFolder folder_;
};

TEST_F(MountingRunTest, OfAGoodLogNothingIsCorrected) {
  const auto result = run(home());
  EXPECT_EQ(result.code, base::ExitCode::ok) << result.text;
  EXPECT_EQ(result.text.find("CORRECTED"), std::string::npos) << result.text;
  EXPECT_EQ(ini().find("\n["), std::string::npos) << ini();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/report.txt"));
  for (const std::string words : {"'kinect'       yaw", "'kinect'       pitch", "'kinect'       height",
                                  "'kinect'       depth scale", "'kinect'       focal length", "'odometry'     clock",
                                  "'laser' pitch, roll, height: no beams ahead meet the floor"})
    EXPECT_NE(result.text.find(words), std::string::npos) << words << "\n" << result.text;
}

TEST_F(MountingRunTest, ThePoseOfACameraIsMeasuredWithinItsStandardDeviation) {
  const auto& pose = [](auto& one) {
    one.sensorPose = mrpt::poses::CPose3D(0.2, 0, 1.25, 0.06, 0.2, -0.03);  // 3.4, 11.5 and -1.7 deg
  };
  auto log = withFault(home(), {DeclaredFault::camera_yaw, 0});  // copies of the images
  each<mrpt::obs::CObservation3DRangeScan>(log, pose);
  const auto result = run(log);
  EXPECT_EQ(result.code, base::ExitCode::ok) << result.text;
  EXPECT_NEAR(value("place_of_kinect", "pose_yaw_deg"), 0, 0.35) << ini();
  EXPECT_NEAR(value("place_of_kinect", "pose_pitch_deg"), 10, 0.25);
  EXPECT_NEAR(value("place_of_kinect", "pose_roll_deg"), 0, 0.25);
  EXPECT_NEAR(value("place_of_kinect", "pose_z_m"), 1.1, 0.015);
  EXPECT_EQ(value("place_of_kinect", "pose_x_m"), 0.2) << "nothing measures it";
  EXPECT_NE(ini().find("; +- "), std::string::npos) << "the standard deviations";
  EXPECT_NE(ini().find("[mapper]\nsensors = place_of_kinect\n"), std::string::npos) << ini();
  // Given to a check, the INI leaves nothing to find.
  testing::MemorySource source(log);
  for (const auto& finding :
       judge(gatherFacts(source, Declared::read(base::Config::fromFile(folder_ / "out/mounting.ini")))))
    EXPECT_EQ(finding.weight, Weight::note) << finding.text;
}

TEST_F(MountingRunTest, ScaleFocalLengthAndClockOfACameraAreMeasured) {
  auto log = withFault(home(), {DeclaredFault::depth_scale, 1.25});
  log = withFault(log, {DeclaredFault::camera_clock, 0.4});
  const auto result = run(log);
  EXPECT_EQ(result.code, base::ExitCode::ok) << result.text;
  EXPECT_NEAR(value("calibration", "depth_scale"), 0.8, 0.008) << ini();
  EXPECT_NEAR(value("place_of_kinect", "clock_offset_s"), -0.4, 0.03);
}

TEST_F(MountingRunTest, AYawedLaserIsCorrectedAndItsCameraIsNot) {
  const auto result = run(withFault(home(), {DeclaredFault::laser_yaw, 30}));
  EXPECT_EQ(result.code, base::ExitCode::ok) << result.text;
  EXPECT_NEAR(value("place_of_laser", "pose_yaw_deg"), 0, 1.5) << ini();
  const double yaw = value("place_of_kinect", "pose_yaw_deg");
  EXPECT_TRUE(std::isnan(yaw) || std::abs(yaw) < 1.5) << ini();
}

TEST_F(MountingRunTest, WhatHasTwoCausesIsNamedAndWrittenAsAComment) {
  const auto log = halfALap();
  for (const auto kind : {DeclaredFault::laser_sense, DeclaredFault::wheels_left_right}) {
    const auto result = run(withFault(log, {kind}));
    EXPECT_EQ(result.code, base::ExitCode::doubtful_input) << result.text;
    for (const std::string words :
         {"TWO CAUSES", "Either the laser is upside down", "Or the wheels take left for right"})
      EXPECT_NE(result.text.find(words), std::string::npos) << result.text;
    EXPECT_TRUE(std::isnan(value("place_of_laser", "pose_roll_deg"))) << ini();
    EXPECT_NE(ini().find("; pose_roll_deg = 180.00\n"), std::string::npos) << ini();
  }
}

TEST_F(MountingRunTest, TheClockOfWheelsIsMeasuredInTheSectionThatTheIniHas) {
  const std::string text =
      "[mapper]\npose_plugins = scan_odometry\nsensors = wheels\n[wheels]\nlabel = odometry\nclock_offset_s = 0.5\n";
  const auto result =
      run(withFault(halfALap(), {DeclaredFault::wheels_clock, 2}), base::Config::fromText(text, "test.ini"));
  EXPECT_EQ(result.code, base::ExitCode::ok) << result.text;
  EXPECT_NEAR(value("wheels", "clock_offset_s"), -2, 0.03) << ini();
  EXPECT_EQ(ini().find("sensors ="), std::string::npos) << "the list of the INI stays";
}

TEST_F(MountingRunTest, ALogThatDeterminesNothingIsRefusedAndNothingIsWritten) {
  Observations odometry;
  for (const auto& observation : halfALap()) {
    if (dynamic_cast<const CObservationOdometry*>(observation.get())) odometry.push_back(observation);
  }
  try {
    run(odometry);
    ADD_FAILURE() << "it was measured";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::nothing_to_map);
    EXPECT_NE(std::string(error.what()).find("neither lasers nor depth cameras"), std::string::npos) << error.what();
  }
  EXPECT_EQ(ini(), "");
}

/// Facts of a log with one camera, but no laser.
LogFacts facts() {
  LogFacts facts;
  facts.sensors[{"kinect", "mrpt::obs::CObservation3DRangeScan"}].count = 50;
  CameraFacts camera;
  camera.camera = "kinect";
  camera.declared = mrpt::poses::CPose3D(0.2, 0, 1.1, 0, 0.17, 0);
  camera.pose = camera.declared;
  camera.height = Measured{0.55, 0.01};
  camera.tilt_sigma = 0.001;
  camera.floor_images = 10;
  facts.cameras.push_back(camera);
  return facts;
}

const Quantity& quantityOf(const SensorMounting& mounting, const std::string& name) {
  const auto found = std::find_if(mounting.quantities.begin(), mounting.quantities.end(),
                                  [&](const Quantity& one) { return one.name == name; });
  EXPECT_NE(found, mounting.quantities.end()) << name;
  return *found;
}

TEST(SensorMounting, WithoutALaserHeightAndUnitCannotBeToldApart) {
  const auto mounting = sensorMounting(facts(), {});
  EXPECT_EQ(quantityOf(mounting, "height").state, State::two_causes);
  EXPECT_EQ(quantityOf(mounting, "depth scale").state, State::not_determined);
  ASSERT_EQ(mounting.two_causes.size(), 1U);
  EXPECT_NEAR(mounting.two_causes.front().keys.pose->z(), 0.55, 1e-9);
  const auto ini = mountingIni(mountingLines(mounting, base::Config::fromFiles({}), true), mounting, "a.rawlog");
  EXPECT_NE(ini.find("; pose_z_m = 0.550\n"), std::string::npos) << ini;
  EXPECT_EQ(ini.find("\n["), std::string::npos) << ini;
}

TEST(SensorMounting, TheFloorShowsPitchWithoutALaser) {
  auto log = facts();
  auto& camera = log.cameras.front();
  camera.height = Measured{1.1, 0.01};
  camera.pose = mrpt::poses::CPose3D(0.2, 0, 1.1, 0, 0.20, 0);
  camera.tilt = 0.03;
  const auto mounting = sensorMounting(log, {});
  EXPECT_EQ(quantityOf(mounting, "pitch").state, State::corrected);
  EXPECT_EQ(quantityOf(mounting, "height").state, State::as_declared);
  EXPECT_NEAR(mounting.sensors.at("kinect").pose->pitch(), 0.20, 1e-9);
  // As large as the noise, it is as declared, unless an earlier round corrected it.
  camera.tilt = 0.002;
  EXPECT_EQ(quantityOf(sensorMounting(log, {}), "pitch").state, State::as_declared);
  EXPECT_EQ(quantityOf(sensorMounting(log, {{"kinect", "pitch"}}), "pitch").state, State::corrected);
}

}  // namespace
}  // namespace omnimapper::check::mounting_run_test

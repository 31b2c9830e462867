#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

// Compares whole maps of simulated logs with the truth. The bounds are about twice the measured errors.
namespace omnimapper::mapper::engine_simulated_test {
namespace {

using mrpt::poses::CPose3D;
using testing::kLaserIni;
using testing::makeEngine;
using testing::SimulatedLog;
using testing::SimulatedLogOptions;
using testing::trajectoryError;

SimulatedLogOptions ring(double laps) {
  SimulatedLogOptions options;
  options.laps = laps;
  return options;
}

std::size_t closures(const View& view, bool accepted) {
  return static_cast<std::size_t>(std::count_if(view.decisions.begin(), view.decisions.end(), [&](const auto& d) {
    return d.kind == "loop closure" && d.accepted == accepted;
  }));
}

// Error of odometry alone on the log [m].
double odometryError(const SimulatedLog& log) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& observation : log.observations()) {
    const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(observation.get());
    if (!odometry) continue;
    const auto truth = log.truthAt(odometry->timestamp);
    sum += std::pow(odometry->odometry.x() - truth.x(), 2) + std::pow(odometry->odometry.y() - truth.y(), 2);
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

TEST(EngineSimulated, TwoLapsOfTheRingCloseAndLieOnTheTruth) {
  const SimulatedLog log(ring(2));
  const auto engine = makeEngine(kLaserIni);
  testing::run(*engine, log.observations());
  const double error = trajectoryError(engine->view(), log);
  RecordProperty("trajectory_error_m", std::to_string(error));
  RecordProperty("odometry_error_m", std::to_string(odometryError(log)));
  EXPECT_LT(error, 0.06);
  EXPECT_GT(odometryError(log), 0.8) << "else the test shows nothing";
  EXPECT_GT(closures(engine->view(), true), 20U);
}

TEST(EngineSimulated, AMapInSpaceHasThePlanarTrajectory) {
  const SimulatedLog log(ring(1));
  const auto planar = makeEngine(kLaserIni), spatial = makeEngine(kLaserIni, {"mapper.motion=spatial"});
  testing::run(*planar, log.observations());
  testing::run(*spatial, log.observations());
  const auto& a = planar->view().map.key_frames;
  const auto& b = spatial->view().map.key_frames;
  ASSERT_EQ(a.size(), b.size());
  double farthest = 0, highest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    farthest = std::max(farthest, (a[i].map_from_base - b[i].map_from_base).translation().norm());
    highest = std::max({highest, std::abs(b[i].map_from_base.z()), std::abs(b[i].map_from_base.roll())});
  }
  RecordProperty("farthest_m", std::to_string(farthest));
  EXPECT_LT(farthest, 0.03);
  EXPECT_LT(highest, 1e-6);
}

TEST(EngineSimulated, TwoLasersAtOnceMapAsWellAsOne) {
  auto options = ring(1.4);
  options.lasers.resize(2);
  options.lasers[1].label = "rear";
  options.lasers[1].base_from_sensor = CPose3D(-0.25, 0.05, 0.2, geometry::kPi, 0, 0);
  options.lasers[1].phase += 0.04;
  const SimulatedLog log(options);
  const auto engine = makeEngine(kLaserIni);
  testing::run(*engine, log.observations());
  RecordProperty("trajectory_error_m", std::to_string(trajectoryError(engine->view(), log)));
  EXPECT_LT(trajectoryError(engine->view(), log), 0.06);
  std::map<std::string, std::size_t> owners;
  for (const auto& [id, record] : engine->view().graph.factors()) ++owners[record.tags.owner];
  EXPECT_EQ(owners["scan_odometry"] + 1, engine->view().map.key_frames.size()) << "one laser measures all links";
  std::set<std::string> closed;
  for (const auto& decision : engine->view().decisions) {
    if (!decision.accepted) continue;
    for (const auto& observation : engine->view().map.keyFrame(decision.from).observations) {
      closed.insert(observation->sensorLabel);
    }
  }
  EXPECT_EQ(owners["loop_closure"], closures(engine->view(), true));
  EXPECT_EQ(owners.size(), 2U) << "no other factors";
  EXPECT_GT(closures(engine->view(), true), 4U);
  EXPECT_TRUE(closed.count("laser.points") == 1 && closed.count("rear.points") == 1) << "both find loops";
}

// The trajectory has a line for each scan of the laser that came first, and none for key frames of only the other one.
TEST(EngineSimulated, ASecondLaserAddsNoLinesToTheTrajectory) {
  auto options = ring(0.3);
  options.lasers.resize(2);
  options.lasers[1].label = "second";
  options.lasers[1].phase = 0.057;
  const SimulatedLog log(options);
  const auto engine = makeEngine(kLaserIni);
  testing::run(*engine, log.observations());
  std::set<base::Stamp> first, lines;
  for (const auto& observation : log.observations())
    if (observation->sensorLabel == "laser") first.insert(observation->timestamp);
  for (const auto& pose : map::denseTrajectory(engine->view().map)) lines.insert(pose.stamp);
  std::size_t frames_of_second = 0;
  for (const auto& frame : engine->view().map.key_frames) frames_of_second += first.count(frame.stamp) == 0;
  EXPECT_GT(frames_of_second, 10U);
  EXPECT_EQ(lines, first);
}

TEST(EngineSimulated, ALaserUpsideDownSeesTheSamePlace) {
  auto options = ring(0.5);
  options.lasers[0].base_from_sensor = CPose3D(0.2, 0, 0.3, 0.4, 0, geometry::kPi);
  const SimulatedLog log(options);
  const auto engine = makeEngine(kLaserIni);
  testing::run(*engine, log.observations());
  RecordProperty("trajectory_error_m", std::to_string(trajectoryError(engine->view(), log)));
  EXPECT_LT(trajectoryError(engine->view(), log), 0.06);
}

// The pose of the laser is not in the log but in the INI.
TEST(EngineSimulated, ASensorPoseOfTheIniReplacesThatOfTheLog) {
  auto options = ring(0.5);
  const SimulatedLog simulated(options);
  auto log = simulated.observations();
  for (const auto& observation : log) {
    if (observation->sensorLabel == "laser") observation->setSensorPose(CPose3D());
  }
  const auto right = makeEngine(kLaserIni),
             repaired = makeEngine(kLaserIni + "[front]\nlabel = laser\n",
                                   {"mapper.sensors=front", "front.pose_x_m=0.2", "front.pose_z_m=0.3"});
  testing::run(*right, simulated.observations());
  testing::run(*repaired, log);
  EXPECT_TRUE(testing::bitsOf(repaired->view()) == testing::bitsOf(right->view()));
}

TEST(EngineSimulated, WithoutOdometryTheLaserGivesTheMotion) {
  auto options = ring(0.5);
  options.speed = 0.5;
  const SimulatedLog log(options);
  auto observations = log.observations();
  observations.erase(std::remove_if(observations.begin(), observations.end(),
                                    [](const auto& o) { return o->sensorLabel == "odometry"; }),
                     observations.end());
  const auto engine =
      makeEngine(kLaserIni, {"mapper.pose_plugins=scan_odometry, no_motion", "trigger.every_observation=true"});
  testing::run(*engine, observations);
  EXPECT_EQ(engine->view().map.key_frames.size(), observations.size());
  RecordProperty("trajectory_error_m", std::to_string(trajectoryError(engine->view(), log)));
  EXPECT_LT(trajectoryError(engine->view(), log), 0.15);
}

}  // namespace
}  // namespace omnimapper::mapper::engine_simulated_test

#include "Scenes.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <stdexcept>

namespace omnimapper::fuzz {

namespace {

Observations readLog(const std::string& path, double seconds) {
  source::SourceOptions options;
  options.end = seconds;
  const auto source = source::openLogs({path}, options);
  Observations log;
  while (auto observation = source->next()) log.push_back(std::move(observation));
  if (log.empty()) throw std::runtime_error(path + " has no observation");
  return log;
}

Observations ring() {
  testing::SimulatedLogOptions options;
  options.laps = 0.15;
  options.gps.on = true;
  options.tracker.on = true;
  options.beacons.on = true;
  return testing::SimulatedLog(options).observations();
}

// Replaces the odometry by its motions from one observation to the next.
Observations withMotions(Observations log) {
  const mrpt::obs::CObservationOdometry* before = nullptr;
  for (auto& observation : log) {
    const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation);
    if (!odometry) continue;
    if (before) {
      auto motion = std::make_shared<obs::CObservationRelativeMotion>();
      motion->sensorLabel = "odometry";
      motion->timestamp = odometry->timestamp;
      motion->begin = before->timestamp;
      motion->begin_from_end = mrpt::poses::CPose3D(odometry->odometry - before->odometry);
      motion->covariance.diagonal().setConstant(1e-4);
      observation = std::move(motion);
    }
    before = odometry.get();
  }
  return log;
}

// The log with the true pose of the base, as by a tracker, at each depth image.
Observations withPoses(const Observations& log, const std::string& truth) {
  const auto poses = eval::readTum(truth);
  Observations with;
  for (const auto& observation : log) {
    with.push_back(observation);
    if (observation->sensorLabel != "kinect") continue;
    const auto nearest = std::min_element(poses.begin(), poses.end(), [&](const auto& a, const auto& b) {
      return std::abs(base::secondsBetween(a.stamp, observation->timestamp)) <
             std::abs(base::secondsBetween(b.stamp, observation->timestamp));
    });
    auto pose = mrpt::obs::CObservationRobotPose::Create();
    pose->sensorLabel = "tracker";
    pose->timestamp = observation->timestamp;
    pose->pose.mean = geometry::toMrpt(nearest->world_from_body);
    pose->pose.cov.setZero();
    for (int i = 0; i < 6; ++i) pose->pose.cov(i, i) = 1e-4;
    with.push_back(std::move(pose));
  }
  return with;
}

std::string ini(const std::string& name) {
  return testing::sourceFile("ini/" + name + ".ini");
}

}  // namespace

std::vector<Scene> scenes(const std::string& programs, const std::string& scratch) {
  const std::string home_log = testing::sourceFile("rawlogs/home_30s/home_30s.rawlog"), mapper = "omnimapper-graphslam",
                    perceiver = "omnimapper-perceive", derived = scratch + "/derived.rawlog";
  const auto home = readLog(home_log, 4.5), box = readLog(testing::sourceFile("rawlogs/box/box.rawlog"), 15),
             around = ring();
  const auto made = testing::runProgram({programs + "/" + perceiver, "-i", ini("perceive"), "-r", home_log, "-o",
                                         derived, "--with-raw", "-q", "--set", "source.end_s=4.5"});
  if (made.code != 0) throw std::runtime_error("perceiving " + home_log + " " + toString(made));
  const auto perceived = readLog(derived, 4.5);
  return {{"ring", mapper, ini("laser2d"), around},
          {"motions", mapper, ini("laser2d"), withMotions(around)},
          {"home", mapper, ini("laser2d"), home},
          {"walls", mapper, ini("laser_walls"), home},
          {"planes", mapper, ini("home_planes"), home},
          {"perceived planes", mapper, ini("home_planes"), perceived},
          {"perceived walls", mapper, ini("laser_walls"), perceived},
          {"camera", mapper, ini("rgbd_planes"), withPoses(home, testing::sourceFile("rawlogs/home_30s/truth.tum"))},
          {"box", mapper, ini("landmarks"), box},
          {"beacons", mapper, ini("landmarks"), around},
          {"moved", mapper, ini("moveables"), box},
          {"perceive", perceiver, ini("perceive"), home},
          {"objects", perceiver, ini("objects"), home},
          {"road", perceiver, ini("road"), home}};
}

}  // namespace omnimapper::fuzz

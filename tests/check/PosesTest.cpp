// Findings on absolute poses.
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>

#include "CheckedLog.h"

namespace omnimapper::check::poses_test {
namespace {

TEST(Poses, ThatStandOnTheirSideAreAProblem) {
  const auto textOf = [](double roll) {
    auto log = halfALap();
    for (int i = 0; i < 20; ++i) {
      auto pose = mrpt::obs::CObservationRobotPose::Create();
      pose->sensorLabel = "tracker";
      pose->timestamp = log.back()->timestamp + base::durationFromSeconds(0.1);
      pose->pose.mean = mrpt::poses::CPose3D(i, 0, 1, 0.3 * i, 0.1, roll);
      log.push_back(pose);
    }
    return Checked(log).text();
  };
  EXPECT_NE(textOf(-1.5).find("problem: 'tracker': the poses are not level: on average the base is tilted by"),
            std::string::npos)
      << textOf(-1.5);
  EXPECT_EQ(textOf(-1.5).find("in spite of"), std::string::npos) << textOf(-1.5);
  EXPECT_EQ(textOf(0.3).find("level"), std::string::npos) << textOf(0.3);
  EXPECT_EQ(textOf(0.9).find("problem: 'tracker'"), std::string::npos) << "a camera in the hand that looks down";
  EXPECT_NE(textOf(0.9).find("right for a camera in the hand"), std::string::npos) << textOf(0.9);
}

// Findings on half a lap of a robot on which the accelerometer is tilted by `base_deg`, with poses of a tracker in a
// frame that is tilted by `poses_deg`; no poses for 0.
std::string textOfTilt(double base_deg, double poses_deg) {
  auto log = halfALap();
  const auto begin = log.front()->timestamp;
  const mrpt::poses::CPose3D base(0, 0, 0, 0, 0, base_deg * kPi / 180), frame(0, 0, 0, 0, 0, poses_deg * kPi / 180);
  for (int i = 0; i < 300; ++i) {
    const auto stamp = begin + base::durationFromSeconds(0.02 * i);
    auto imu = mrpt::obs::CObservationIMU::Create();
    imu->sensorLabel = "imu";
    imu->timestamp = stamp;
    const auto force = base.inverseComposePoint(mrpt::math::TPoint3D(0, 0, 9.81));
    imu->set(mrpt::obs::IMU_X_ACC, force.x);
    imu->set(mrpt::obs::IMU_Y_ACC, force.y);
    imu->set(mrpt::obs::IMU_Z_ACC, force.z);
    log.push_back(imu);
    if (poses_deg == 0) continue;
    auto pose = mrpt::obs::CObservationRobotPose::Create();
    pose->sensorLabel = "tracker";
    pose->timestamp = stamp;
    pose->pose.mean = frame + mrpt::poses::CPose3D(0.01 * i, 0, 0, 0, 0, 0) + base;
    log.push_back(pose);
  }
  std::stable_sort(log.begin(), log.end(), [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return Checked(log).text();
}

TEST(Poses, ThatAreNotLevelByTheAccelerometerAreReportedWithAngleAndRemedy) {
  EXPECT_EQ(textOfTilt(0, 0).find("level"), std::string::npos) << textOfTilt(0, 0);
  const auto base = textOfTilt(8, 0);
  EXPECT_NE(base.find("warning: the base is not level: according to the accelerometer 'imu', up is 8.0 +- "),
            std::string::npos)
      << base;
  EXPECT_NE(base.find("roll 8.0 and pitch 0.0 deg"), std::string::npos) << base;
  const auto poses = textOfTilt(0, 20);
  EXPECT_NE(
      poses.find("problem: 'tracker': the poses are not level: according to the accelerometer 'imu', up is 20.0 +- "),
      std::string::npos)
      << poses;
  EXPECT_EQ(poses.find("the base is not level"), std::string::npos) << poses;
}

}  // namespace
}  // namespace omnimapper::check::poses_test

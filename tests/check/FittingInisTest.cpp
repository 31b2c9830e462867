// Which of the project's INIs are named for which sensors.
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/check/fittingInis.h>

#include <memory>

#include "CheckedLog.h"

namespace omnimapper::check::fitting_inis_test {
namespace {

using Names = std::vector<std::string>;

/// Half a lap of laser and odometry, and of another class an observation beside each scan.
template <class Class>
Observations with() {
  Observations all;
  for (const auto& observation : halfALap()) {
    all.push_back(observation);
    if (!std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) continue;
    auto beside = std::make_shared<Class>();
    beside->timestamp = observation->timestamp;
    beside->sensorLabel = "other";
    all.push_back(beside);
  }
  return all;
}

Observations without(Observations all, const std::string& label) {
  all.erase(std::remove_if(all.begin(), all.end(), [&](const auto& o) { return o->sensorLabel == label; }), all.end());
  return all;
}

Names namesFor(const Observations& log) {
  Names names;
  for (const auto& ini : fittingInis(Checked(log).facts)) names.push_back(ini.file);
  return names;
}

TEST(FittingInis, OfALaserAreThoseOfLasers) {
  EXPECT_EQ(namesFor(halfALap()), (Names{"ini/laser2d.ini", "ini/laser_walls.ini"}));
  EXPECT_EQ(namesFor(without(halfALap(), "odometry")), (Names{"ini/laser2d.ini", "ini/laser_walls.ini"}));
}

TEST(FittingInis, OfARangeCameraDependOnWhatTellsItsMotion) {
  const auto log = with<mrpt::obs::CObservation3DRangeScan>();
  EXPECT_EQ(namesFor(log), (Names{"ini/home_planes.ini", "ini/laser2d.ini", "ini/laser_walls.ini"}));
  EXPECT_EQ(namesFor(without(log, "laser")), (Names{"ini/home_planes.ini"}));
  auto alone = without(without(log, "laser"), "odometry");
  EXPECT_EQ(namesFor(alone), Names{});
  EXPECT_TRUE(Checked(alone).says("problem: there is nothing to map")) << Checked(alone).text();
  EXPECT_TRUE(Checked(alone).says("--poses"));
  auto pose = mrpt::obs::CObservationRobotPose::Create();
  pose->timestamp = alone.front()->timestamp;
  alone.push_back(pose);
  EXPECT_EQ(namesFor(alone), (Names{"ini/rgbd_planes.ini"}));
  EXPECT_EQ(Checked(alone).text().find("problem"), std::string::npos) << Checked(alone).text();
  EXPECT_EQ(fittingInis(Checked(alone).facts).front().pose_plugins, (Names{"no_motion"}));
}

TEST(FittingInis, OfRangesAndBearingsNeedOdometry) {
  const auto log = without(with<mrpt::obs::CObservationBearingRange>(), "laser");
  EXPECT_EQ(namesFor(log), (Names{"ini/landmarks.ini"}));
  EXPECT_EQ(Checked(log).text(), "");
  EXPECT_EQ(namesFor(without(log, "odometry")), Names{});
}

TEST(FittingInis, OfNothingButOdometryAreNone) {
  EXPECT_EQ(namesFor(without(halfALap(), "laser")), Names{});
}

}  // namespace
}  // namespace omnimapper::check::fitting_inis_test

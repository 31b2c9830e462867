// Which of the project's INIs fit which sensors.
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/check/fittingInis.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/testing/Fixtures.h>

#include <memory>

#include "CheckedLog.h"

namespace omnimapper::check::fitting_inis_test {
namespace {

using Names = std::vector<std::string>;

/// A log with an observation of another class added after each scan.
template <class Class>
Observations with(const Observations& log = halfALap()) {
  Observations all;
  for (const auto& observation : log) {
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

TEST(FittingInis, OfARangeCameraDependOnWhatMeasuresItsMotion) {
  const auto log = with<mrpt::obs::CObservation3DRangeScan>();
  EXPECT_EQ(namesFor(log),
            (Names{"ini/home_planes.ini", "ini/objects_map.ini", "ini/laser2d.ini", "ini/laser_walls.ini"}));
  EXPECT_EQ(namesFor(without(log, "laser")), (Names{"ini/rgbd_robot.ini", "ini/home_planes.ini"}));
  auto alone = without(without(log, "laser"), "odometry");
  EXPECT_EQ(namesFor(alone), Names{"ini/rgbd_handheld.ini"});
  EXPECT_EQ(Checked(alone).text().find("problem"), std::string::npos) << Checked(alone).text();
  auto pose = mrpt::obs::CObservationRobotPose::Create();
  pose->timestamp = alone.front()->timestamp;
  alone.push_back(pose);
  EXPECT_EQ(namesFor(alone), (Names{"ini/rgbd_planes.ini", "ini/rgbd_handheld.ini"}));
  EXPECT_EQ(Checked(alone).text().find("problem"), std::string::npos) << Checked(alone).text();
  EXPECT_EQ(fittingInis(Checked(alone).facts).front().plugins.pose, (Names{"given_motion", "no_motion"}));
}

TEST(FittingInis, OfCloudsAndPicturesWithOdometryAreNamed) {
  EXPECT_EQ(namesFor(without(with<mrpt::obs::CObservationPointCloud>(), "laser")), Names{"ini/home_planes.ini"});
  EXPECT_EQ(namesFor(without(with<mrpt::obs::CObservationImage>(), "laser")),
            (Names{"ini/signs.ini", "ini/landmarks.ini"}));
  auto posed = without(without(with<mrpt::obs::CObservationPointCloud>(), "laser"), "odometry");
  EXPECT_EQ(namesFor(posed), Names{});
  auto pose = mrpt::obs::CObservationRobotPose::Create();
  pose->timestamp = posed.front()->timestamp;
  posed.push_back(pose);
  EXPECT_EQ(namesFor(posed), Names{"ini/rgbd_planes.ini"});
  EXPECT_EQ(namesFor(without(without(with<mrpt::obs::CObservationImage>(), "laser"), "odometry")), Names{});
}

TEST(FittingInis, GoWithoutTheLaserThatIsNotThere) {
  const Checked checked(without(with<mrpt::obs::CObservation3DRangeScan>(), "laser"));
  EXPECT_EQ(toIni(proposeIni(checked.facts, fittingInis(checked.facts).back().plugins)),
            "; Written from a log by omnimapper-graphslam --check.\n"
            "[mapper]\npose_plugins = odometry, no_motion  ; there is no laser\n"
            "measurement_plugins = plane_landmarks  ; there is no laser\n\n"
            "[perception]\nextractors = planes  ; there is no laser\n");
}

TEST(FittingInis, HaveThePluginsOfTheirFiles) {
  const auto inis = fittingInis(Checked(halfALap()).facts);
  ASSERT_EQ(inis.size(), 2U);
  EXPECT_EQ(inis[0].plugins.pose, (Names{"scan_odometry", "odometry", "no_motion"}));
  EXPECT_EQ(inis[1].plugins.measurement, (Names{"walls", "loop_closure", "relations"}));
  EXPECT_EQ(inis[1].plugins.extractors, (Names{"laser_points", "laser_lines"}));
  EXPECT_TRUE(inis[0].plugins.odometry_is_fallback);
}

TEST(FittingInis, SayWhatTheyMapOfThisLog) {
  const auto log = with<mrpt::obs::CObservation3DRangeScan>();
  EXPECT_EQ(fittingInis(Checked(log).facts).front().what, "walls, tables and floors of the range camera and the laser");
  EXPECT_EQ(fittingInis(Checked(without(log, "laser")).facts).back().what,
            "walls, tables and floors of the range camera");
  const auto clouds = fittingInis(Checked(without(with<mrpt::obs::CObservationPointCloud>(), "laser")).facts);
  EXPECT_TRUE(clouds.front().needs_settings);
  EXPECT_FALSE(clouds.front().is_a_guess);
  const auto pictures = fittingInis(Checked(with<mrpt::obs::CObservationImage>()).facts);
  ASSERT_EQ(pictures.size(), 4U);
  EXPECT_EQ(pictures[2].what, "door signs, if the pictures show some, and walls");
  EXPECT_TRUE(pictures[2].is_a_guess);
  EXPECT_FALSE(pictures[2].needs_settings);
  EXPECT_TRUE(pictures[3].is_a_guess && pictures[3].needs_settings);
  const auto signs = fittingInis(Checked(with<obs::CObservationDoorSigns>()).facts);
  EXPECT_EQ(signs.back().what, "door signs with their texts, and walls");
  EXPECT_FALSE(signs.back().is_a_guess);
}

TEST(FittingInis, OfRangesAndBearingsNeedOdometry) {
  const auto log = without(with<mrpt::obs::CObservationBearingRange>(), "laser");
  EXPECT_EQ(namesFor(log), (Names{"ini/landmarks.ini"}));
  EXPECT_EQ(Checked(log).text(), "");
  EXPECT_EQ(namesFor(without(log, "odometry")), Names{});
}

TEST(FittingInis, OfNothingButOdometryAreNone) {
  const Checked checked(without(halfALap(), "laser"));
  EXPECT_EQ(namesFor(without(halfALap(), "laser")), Names{});
  EXPECT_TRUE(checked.says("problem: there is nothing to map")) << checked.text();
}

}  // namespace
}  // namespace omnimapper::check::fitting_inis_test

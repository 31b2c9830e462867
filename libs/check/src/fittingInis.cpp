#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <omnimapper/check/fittingInis.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/obs/CObservationPlanes.h>

#include <algorithm>

namespace omnimapper::check {

namespace {

template <class Class>
bool holds(const LogFacts& facts) {
  const std::string name = CLASS_ID(Class)->className;
  return std::any_of(facts.sensors.begin(), facts.sensors.end(),
                     [&](const auto& sensor) { return sensor.first.second == name; });
}

}  // namespace

std::vector<FittingIni> fittingInis(const LogFacts& facts) {
  const bool has_laser = !usableLasers(facts).empty(), has_odometry = usableOdometry(facts).has_value();
  const bool sees_depth = holds<mrpt::obs::CObservation3DRangeScan>(facts) || holds<obs::CObservationPlanes>(facts);
  const std::vector<std::string> of_lasers{"scan_odometry", "odometry", "no_motion"};  // pose plugins
  std::vector<FittingIni> inis;
  if (holds<mrpt::obs::CObservation3DRangeScan>(facts) && has_odometry && !has_laser) {
    inis.push_back(
        {"ini/rgbd_robot.ini",
         "walls, tables and floors of the range camera; its motion from images and wheels",
         {{"visual_odometry", "odometry", "no_motion"}, {"planes"}, {"plane_landmarks", "view_links"}, true}});
  }
  if (sees_depth && (has_laser || has_odometry)) {
    inis.push_back({"ini/home_planes.ini",
                    std::string("walls, tables and floors of the range camera") + (has_laser ? " and the laser" : ""),
                    {of_lasers, {"planes", "laser_lines", "laser_points"}, {"plane_landmarks", "loop_closure"}, true}});
  }
  if (has_laser) {
    inis.push_back({"ini/laser2d.ini",
                    "an occupancy grid of the laser's scans",
                    {of_lasers, {"laser_points"}, {"loop_closure"}, true}});
    inis.push_back({"ini/laser_walls.ini",
                    "an occupancy grid of the laser's scans, and walls as landmarks",
                    {of_lasers, {"laser_points", "laser_lines"}, {"walls", "loop_closure", "relations"}, true}});
  }
  const bool has_signs = holds<obs::CObservationDoorSigns>(facts);
  if ((has_signs || holds<mrpt::obs::CObservationImage>(facts)) && (has_laser || has_odometry)) {
    const std::string what = has_signs ? "door signs with their texts" : "door signs, if the pictures show some";
    inis.push_back({"ini/signs.ini",
                    what + (has_laser ? ", and walls" : ""),
                    {of_lasers,
                     {"signs", "laser_points", "laser_lines"},
                     {"walls", "loop_closure", "sign_landmarks", "relations"},
                     true},
                    false,
                    !has_signs});
  }
  if (sees_depth && holds<mrpt::obs::CObservationRobotPose>(facts)) {
    inis.push_back({"ini/rgbd_planes.ini",
                    "walls, tables and floors of a range camera on given poses",
                    {{"given_motion", "no_motion"}, {"planes"}, {"poses", "plane_landmarks"}, false}});
  }
  if (holds<mrpt::obs::CObservation3DRangeScan>(facts) && !has_laser && !has_odometry) {
    inis.push_back({"ini/rgbd_handheld.ini",
                    "trajectory, planes and points of a range camera, from its images alone",
                    {{"visual_odometry", "no_motion"}, {"planes"}, {"view_links", "plane_landmarks"}, false}});
  }
  if (has_odometry && holds<mrpt::obs::CObservationBearingRange>(facts)) {
    inis.push_back({"ini/landmarks.ini",
                    "points and markers, from ranges and bearings",
                    {{"odometry", "no_motion"}, {}, {"points"}, false}});
  }
  const bool sees_clouds =
      holds<mrpt::obs::CObservationPointCloud>(facts) || holds<mrpt::obs::CObservationVelodyneScan>(facts);
  if (has_odometry && sees_clouds && !sees_depth) {
    inis.push_back({"ini/home_planes.ini",
                    "planes of point clouds; needs --set planes.class=CloudPlaneExtractor",
                    {{"odometry", "no_motion"}, {"planes"}, {"plane_landmarks"}, true},
                    true});
  }
  if (sees_clouds && !sees_depth && holds<mrpt::obs::CObservationRobotPose>(facts)) {
    inis.push_back({"ini/rgbd_planes.ini",
                    "planes of point clouds on given poses; needs --set planes.class=CloudPlaneExtractor",
                    {{"given_motion", "no_motion"}, {"planes"}, {"poses", "plane_landmarks"}, false},
                    true});
  }
  if (has_odometry && holds<mrpt::obs::CObservationImage>(facts) &&
      !holds<mrpt::obs::CObservationBearingRange>(facts)) {
    inis.push_back({"ini/landmarks.ini",
                    "ArUco markers, if the pictures show some; for the settings see README, \"Landmarks\"",
                    {{"odometry", "no_motion"}, {}, {"points"}, false},
                    true,
                    true});
  }
  return inis;
}

}  // namespace omnimapper::check

#pragma once

// Simulated drives in company and through bare corridors, and how far off their maps are.
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "UntunedLogs.h"

namespace company {

namespace eval = omnimapper::eval;
using Settings = std::vector<std::string>;  ///< section.key=value

/// The corridor of 44 m between two rooms, through which the robot drives once.
inline const char* const kCorridor = R"([world]
rooms = west, hall, east
doors = d1, d2
[west]
class = room
rectangle_m = 0 0 5 5
[hall]
class = room
rectangle_m = 5.15 1.4 45.15 3.6
[east]
class = room
rectangle_m = 45.3 0 50.3 5
[d1]
class = passage
rooms = west, hall
x_m = 5.07
y_m = 2.5
width_m = 1.2
[d2]
class = passage
rooms = hall, east
x_m = 45.22
y_m = 2.5
width_m = 1.2
[anna]
class = companion
place = ahead
[ben]
class = companion
place = ahead
side_m = 0.6
[cleo]
class = companion
place = ahead
side_m = -0.6
distance_m = 1.2
[dora]
class = companion
place = beside
side_m = 0.75
[emil]
class = companion
place = beside
side_m = -0.75
[robot]
mode = waypoints
start = 2.0 2.5 0
waypoints = 2.0 2.5, 46.0 2.5
[laser]
class = Laser2d
model = sick_lms291
x_m = 0.15
z_m = 0.35
[odometry]
class = Odometry
rate_hz = 20
[simulation]
sensors = laser, odometry
)";

/// A corridor with closed ends, through which the robot drives there and back at 1 m/s with wheels exact to 0.1 %.
inline std::string bareCorridor(int length, const std::string& laser) {
  return "[world]\nrooms = hall\n[hall]\nclass = room\nrectangle_m = 0 0 " + std::to_string(length + 4) +
         " 2.4\n[robot]\nmode = waypoints\nmax_speed_m_s = 1\nstart = 2 1.2 0\nwaypoints = 2 1.2, " +
         std::to_string(length + 2) + " 1.2, 2 1.2\n[laser]\nclass = Laser2d\n" + laser +
         "\nx_m = 0.15\nz_m = 0.35\n[odometry]\nclass = Odometry\nrate_hz = 20\nradius_bias = 0.001\n"
         "slip_per_root_m = 0.001\n[simulation]\nsensors = laser, odometry\n";
}

/// Simulates a log into `folder`, unless it is there already. None if the simulator fails.
inline std::optional<untuned::Log> simulated(const std::string& folder, const std::string& ini,
                                             const Settings& settings) {
  namespace tests = omnimapper::testing;
  const std::string name = std::filesystem::path(ini).stem();
  untuned::Log log{name, folder + "/" + name + ".rawlog", folder + "/truth.tum"};
  if (std::filesystem::exists(log.path)) return log;
  std::vector<std::string> command{tests::ownProgram("omnimapper-simulate"), "-q", "-i", ini, "-o", folder};
  for (const auto& setting : settings) command.insert(command.end(), {"--set", setting});
  const auto ended = tests::runProgram(command, {900, 0});
  if (ended.code == 0) return log;
  std::fprintf(stderr, "%s could not be simulated: %s\n", folder.c_str(), tests::toString(ended).c_str());
  return std::nullopt;
}

struct Mapped {
  eval::Trajectory trajectory;
  std::string verdict;
};

inline std::optional<Mapped> mapped(const untuned::Log& log, const std::string& folder, const Settings& settings) {
  namespace tests = omnimapper::testing;
  std::vector<std::string> command{tests::ownProgram("omnimapper-graphslam"),
                                   "-q",
                                   "-i",
                                   tests::sourceFile("ini/laser2d.ini"),
                                   "-r",
                                   log.path,
                                   "-o",
                                   folder};
  command.insert(command.end(), {"--set", "mapper.output_plugins=trajectory,summary"});
  for (const auto& setting : settings) command.insert(command.end(), {"--set", setting});
  const auto ended = tests::runProgram(command, {900, 0});
  if (ended.code != 0) {
    std::fprintf(stderr, "%s: %s\n", folder.c_str(), tests::toString(ended).c_str());
    return std::nullopt;
  }
  const auto summary = nlohmann::json::parse(std::ifstream(folder + "/summary.json"));
  return Mapped{eval::readTum(folder + "/trajectory.tum"), summary.at("verdict").at("verdict")};
}

struct Pose {
  double x, y, yaw;
};

inline Pose planar(const omnimapper::geometry::Se3& pose) {
  const Eigen::Vector3d forwards = pose.rotation * Eigen::Vector3d::UnitX();
  return {pose.translation.x(), pose.translation.y(), std::atan2(forwards.y(), forwards.x())};
}

/// The true pose at a stamp; none more than 0.1 s away from one that is in the file.
inline std::optional<Pose> poseAt(const eval::Trajectory& truth, omnimapper::base::Stamp stamp) {
  const auto after =
      std::lower_bound(truth.begin(), truth.end(), stamp, [](const auto& pose, auto at) { return pose.stamp < at; });
  if (after == truth.end() || std::abs(omnimapper::base::secondsBetween(stamp, after->stamp)) > 0.1)
    return std::nullopt;
  const Pose b = planar(after->world_from_body);
  if (after == truth.begin() || after->stamp == stamp) return b;
  const Pose a = planar(std::prev(after)->world_from_body);
  const double part = omnimapper::base::secondsBetween(std::prev(after)->stamp, stamp) /
                      omnimapper::base::secondsBetween(std::prev(after)->stamp, after->stamp);
  return Pose{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y),
              a.yaw + part * std::remainder(b.yaw - a.yaw, 2 * M_PI)};
}

/// Largest errors along x [m] and in heading [rad], after the first pose was aligned.
struct Largest {
  double along = 0, heading = 0;
};

inline Largest largestErrors(const eval::Trajectory& trajectory, const eval::Trajectory& truth) {
  Largest largest;
  std::optional<std::pair<Pose, Pose>> first;  // estimated and true
  for (const auto& stamped : trajectory) {
    const auto at = poseAt(truth, stamped.stamp);
    if (!at) continue;
    const Pose estimate = planar(stamped.world_from_body);
    if (!first) first.emplace(estimate, *at);
    const double turn = first->second.yaw - first->first.yaw, dx = estimate.x - first->first.x,
                 dy = estimate.y - first->first.y;
    const double x = first->second.x + std::cos(turn) * dx - std::sin(turn) * dy;
    largest.along = std::max(largest.along, std::abs(x - at->x));
    largest.heading = std::max(largest.heading, std::abs(std::remainder(estimate.yaw + turn - at->yaw, 2 * M_PI)));
  }
  return largest;
}

/// Largest error along x [m] of the wheels' motions, where the true heading is given.
inline double wheelsError(const untuned::Log& log, const eval::Trajectory& truth) {
  double largest = 0;
  std::optional<mrpt::poses::CPose2D> before;
  std::optional<Pose> last;
  double x = 0, y = 0;
  for (const auto& observation : untuned::read(log)) {
    const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation);
    const auto at = odometry ? poseAt(truth, odometry->timestamp) : std::nullopt;
    if (!at) continue;
    if (before) {
      const auto step = odometry->odometry - *before;
      x += std::cos(last->yaw) * step.x() - std::sin(last->yaw) * step.y();
      y += std::sin(last->yaw) * step.x() + std::cos(last->yaw) * step.y();
    } else {
      x = at->x;
      y = at->y;
    }
    largest = std::max(largest, std::abs(x - at->x));
    before = odometry->odometry;
    last = at;
  }
  return largest;
}

}  // namespace company

#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/sim_world/World.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

enum class DriveMode {
  tour,       ///< drives through all rooms, so that everything in them is seen
  waypoints,  ///< drives along named places
  still,      ///< stays at its start
};

/// How the robot moves: section [robot] of an INI. This is the true motion, without slip; the sensor Odometry simulates
/// what wheels report.
struct DriveOptions {
  DriveMode mode = DriveMode::tour;
  std::string waypoints;  ///< "kitchen, 1.5 2, 3 4 90": names of rooms, or x y [m] and perhaps a heading [deg]
  std::string start;      ///< start of the drive, as one waypoint; empty: the first waypoint or place of the tour
  std::vector<std::string> rooms;    ///< rooms of a tour; none: all that can be reached
  double radius = 0.25;              ///< of the robot, about the origin of its base [m]
  double max_speed = 0.5;            ///< [m/s]
  double max_turn = 1.0;             ///< [rad/s]
  double max_acceleration = 0.5;     ///< largest along the path, and also largest across it [m/s^2]
  double max_turn_acceleration = 2;  ///< [rad/s^2]
  double pause = 0;  ///< stay at each waypoint or place of the tour [s]; 0: waypoints without a heading are driven past
  double look_around = 2 * 3.14159265358979323846;  ///< angle that the robot turns at each place of a tour [rad]
  double reach = 3;  ///< what was within this distance of the robot counts as seen on a tour [m]
  int repeat = 1;
  double duration = 0;        ///< time at which the repeated drive is cut off [s]; 0: it lasts `repeat` rounds
  bool handheld = false;      ///< a walking person carries the base, which is at eye height and sways
  double eye_height = 1.5;    ///< [m]
  double sway = 0.03;         ///< amplitude of the walker's sway [m]
  double sway_turn = 0.05;    ///< [rad]
  double gaze = 0.35;         ///< amplitude of the slow turning of the gaze [rad]
  double shake = 0.002;       ///< amplitude of the hands' shake [m]
  double shake_turn = 0.005;  ///< [rad]
  static const base::OptionTable<DriveOptions>& table();
};

/// Longest drive and longest run [s].
constexpr double kLongestRun = 6 * 3600;

/// Number of poses per second of a planned track.
constexpr int kDriveRate = 100;

/// True track of the robot's base, of kind motion, sampled at kDriveRate from time 0 on; the last place of the track is
/// the end of the drive. The base stands on the floor (z, pitch and roll are those of the ground under its radius) and
/// keeps its radius from all obstacles; it drives forward or turns in place. Velocities and accelerations stay within
/// the options. If handheld, the base is the carried frame, x forward and z up, at eye height, with sway and shake that
/// the world's seed and the options determine. Throws base::Error(out_of_range), which names file, section, key, the
/// place that cannot be reached and the nearest place that can, and what ConfigSection::read() throws.
Track planDrive(const base::Config& config, const World& world);

/// A stay of the robot in a room of World::rooms.
struct Visit {
  int room = 0;
  double enter = 0, leave = 0;  ///< [s]
};
/// Times at which the base's origin is in each room, in order of entering. A doorway counts as part of the room that
/// the base comes from.
std::vector<Visit> visitsOf(const World& world, const Track& map_from_base);

}  // namespace omnimapper::sim

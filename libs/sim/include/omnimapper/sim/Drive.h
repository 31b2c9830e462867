#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/sim_world/World.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

enum class DriveMode {
  tour,       ///< through all rooms, so that all of each is seen
  waypoints,  ///< along named places
  still,      ///< stays at its start
};

/// How the robot moves: section [robot] of an INI. Without slip; what its wheels report is the sensor Odometry's.
struct DriveOptions {
  DriveMode mode = DriveMode::tour;
  std::string waypoints;             ///< "kitchen, 1.5 2, 3 4 90": rooms, or x y and perhaps a heading
  std::string start;                 ///< one of the same; empty: the first waypoint, or the first place of the tour
  std::vector<std::string> rooms;    ///< of the tour; none: all that can be reached
  double radius = 0.25;              ///< of the robot, about the base's origin [m]
  double max_speed = 0.5;            ///< [m/s]
  double max_turn = 1.0;             ///< [rad/s]
  double max_acceleration = 0.5;     ///< along the way and, apart from it, across [m/s^2]
  double max_turn_acceleration = 2;  ///< [rad/s^2]
  double pause = 0;                  ///< at each waypoint or place of the tour [s]; 0: waypoints are passed by
  double look_around = 2 * 3.14159265358979323846;  ///< turned at each place of a tour [rad]
  double reach = 3;                                 ///< what a tour has been this near to counts as seen [m]
  int repeat = 1;
  double duration = 0;        ///< [s]; 0: what `repeat` takes; else repeated until then, and cut there
  bool handheld = false;      ///< carried by somebody who walks: the base is at eye height and sways
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

/// Poses in a second of a planned track.
constexpr int kDriveRate = 100;

/// The robot's true way, of kind motion, sampled at kDriveRate from time 0 on; its last place is the end of the drive.
/// The base is on the floor below it (z of its origin, pitch and roll of the ground under its radius) and keeps its
/// radius from all obstacles; it drives forward or turns in place. Velocities and accelerations stay within the
/// options. Hand-held: the camera's carrier, x forward, z up, at eye height, with wander that the world's seed and the
/// options decide. Throws base::Error out_of_range naming file, section, key, the place that cannot be reached and the
/// nearest one that can; and what ConfigSection::read throws.
Track planDrive(const base::Config& config, const World& world);

/// A stay of the robot in a room of World::rooms.
struct Visit {
  int room = 0;
  double enter = 0, leave = 0;  ///< [s]
};
/// When the base's origin was in which room, in order of entering; doorways belong to the room before.
std::vector<Visit> visitsOf(const World& world, const Track& map_from_base);

}  // namespace omnimapper::sim

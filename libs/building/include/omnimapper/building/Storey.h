#pragma once

#include <omnimapper/geometry/Segment2.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

/// The vocabulary of a building. Positions are in the frame of the map [m]; confidences are between 0 and 1.
namespace omnimapper::building {

/// What speaks for a door.
struct DoorEvidence {
  double narrowing = 0;       ///< width, divided by that of the largest circle that fits into the smaller room
  double wall_coverage = 0;   ///< share of wall on the line of the door, between its two rooms
  double aligned_wall = 0;    ///< share of wall on the line beyond the end of the door that has less of it
  double wall_crossings = 0;  ///< share of walls that run through the ends of the door instead of ending there
};

/// A place at which one room ends and another begins, and through which a robot can pass or look.
struct Door {
  int id = 0;
  double confidence = 0;       ///< that the door separates two rooms
  geometry::Segment2 opening;  ///< from wall to wall
  double width = 0;            ///< [m]
  std::array<int, 2> rooms{};  ///< ids, the lower one first
  DoorEvidence evidence;
};

struct Room {
  int id = 0;
  double confidence = 0;                             ///< that this is one whole room
  double area = 0;                                   ///< [m^2], with the furniture in it
  double openness = 0;                               ///< share of the outline behind which nothing has been seen
  std::vector<Eigen::Vector2d> outline;              ///< counter-clockwise
  std::vector<std::vector<Eigen::Vector2d>> holes;   ///< clockwise
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< the point of the room that is farthest from walls
  double clearance = 0;                              ///< [m] distance of the centre from the nearest wall
  std::vector<int> neighbours;                       ///< sorted ids of the rooms behind its doors
  std::optional<int> split_from;                     ///< the room of an earlier map of which this one was a part

  /// Whether so much of the outline has not been seen that the room may go on there.
  bool isOpen() const { return openness > 0.2; }
};

/// One floor. Rooms and doors are sorted by id.
struct Storey {
  int id = 1;
  std::vector<Room> rooms;
  std::vector<Door> doors;
  int next_room = 1, next_door = 1;  ///< ids that no room or door has had yet
};

struct Building {
  std::vector<Storey> storeys;
};

}  // namespace omnimapper::building

#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/geometry/Se2.h>
#include <omnimapper/geometry/Segment2.h>

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// The vocabulary of a building. Positions are in the frame of the map [m]; confidences are between 0 and 1.
namespace omnimapper::building {

/// Coordinates in documents are at most so far from zero [m]: what is farther away is damage.
inline constexpr double kFarthest = 1e6;

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

/// Something that speaks for the name or the kind of a room.
struct NameEvidence {
  enum class Source { sign, contents, user };
  Source source = Source::sign;
  std::string what;  ///< in words: "sign \"213\" (0:111), 0.3 m beside door 4"
  double confidence = 0;
};
std::string toString(NameEvidence::Source source);

/// The key frame near a room, and where it was when the room was found. If it is elsewhere later, because a loop was
/// closed, so is the room (movedWith()).
struct Anchor {
  base::KeyFrameId frame;
  geometry::Se2 map_from_frame;
};

struct Room {
  int id = 0;
  std::string name;               ///< "213": that of a sign or of a user; empty if none is known
  double name_confidence = 0;     ///< that the room is called so
  std::string kind;               ///< "kitchen": the likeliest kind by what is in it; empty if nothing speaks for one
  double kind_confidence = 0;     ///< that the room is of this kind
  std::vector<NameEvidence> why;  ///< what speaks for name and kind
  double confidence = 0;          ///< that this is one whole room
  double area = 0;                ///< [m^2], with the furniture in it
  double openness = 0;            ///< share of the outline behind which nothing has been seen
  std::vector<Eigen::Vector2d> outline;              ///< counter-clockwise
  std::vector<std::vector<Eigen::Vector2d>> holes;   ///< clockwise
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< the point of the room that is farthest from walls
  double clearance = 0;                              ///< [m] distance of the centre from the nearest wall
  std::vector<int> neighbours;                       ///< sorted ids of the rooms behind its doors
  std::optional<int> split_from;                     ///< the room of an earlier map of which this one was a part
  std::optional<Anchor> anchor;

  /// Whether so much of the outline has not been seen that the room may go on there.
  bool isOpen() const { return openness > 0.2; }
};

/// A kind is used as a name if it is at least as sure as this.
inline constexpr double kSureKind = 0.8;

/// "213", "kitchen" if its kind is sure, else "room 3".
std::string nameOf(const Room& room);

/// Whether its name is that of a user.
bool isNamedByUser(const Room& room);

/// What pictures show: "213 (3)", "kitchen (3)", or the number alone.
std::string labelOf(const Room& room);

/// Whether a point [m] lies in the outline of a room and in none of its holes.
bool contains(const Room& room, const Eigen::Vector2d& point);

/// A room whose door is known by its sign, but which was not seen itself.
struct UnseenRoom {
  std::string name;
  Eigen::Vector2d door = Eigen::Vector2d::Zero();  ///< where the door must be
  std::optional<int> seen_from;                    ///< the room on this side of the door
  double confidence = 0;                           ///< that the room behind that door is called so
  std::vector<NameEvidence> why;
};

/// One floor. Rooms and doors are sorted by id.
struct Storey {
  int id = 1;
  std::vector<Room> rooms;
  std::vector<Door> doors;
  std::vector<UnseenRoom> unseen;    ///< by name
  int next_room = 1, next_door = 1;  ///< ids that no room or door has had yet
};

/// The room at a point of the frame of the map [m]; null if it is in none.
const Room* roomAt(const Storey& storey, const Eigen::Vector2d& point);
/// The room of a thing whose middle is at a point: if it hangs on a wall, or is one, the room on its free side (a
/// direction from it; none if it is not known); else the room that it is in, or up to 1 m outside of, as things at
/// walls are. Null if it is in none.
const Room* roomOfThing(const Storey& storey, const Eigen::Vector2d& middle,
                        const std::optional<Eigen::Vector2d>& free_side);
/// The room nearest to a point, and its distance [m], 0 inside.
struct NearRoom {
  const Room* room;
  double distance;
};
/// None if there are no rooms.
std::optional<NearRoom> nearestRoom(const Storey& storey, const Eigen::Vector2d& point);
/// Null if there is no room of that id.
const Room* roomOf(const Storey& storey, int id);

struct Building {
  std::vector<Storey> storeys;
};

/// The pose of a key frame in the map; none if the map has no such key frame.
using MapFromFrame = std::function<std::optional<geometry::Se2>(base::KeyFrameId)>;
/// The storey with each room moved as its anchor was: from where the key frame was when the room was found to where
/// `now` says that it is. Doors move with the first of their rooms. What has no anchor, or one of which nothing is
/// known, stays.
Storey movedWith(Storey storey, const MapFromFrame& now);

}  // namespace omnimapper::building

#pragma once

#include <omnimapper/sim_world/People.h>
#include <omnimapper/sim_world/Triangulate.h>
#include <omnimapper/sim_world/World.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Plain descriptions of all that is in a world, as sections of an INI give it or as generators make it. Positions are
/// in the map. `name` is the section's name. makeWorld() checks the descriptions and builds the world.

/// Largest area of the rectangle that all rooms of a world lie in [m^2].
constexpr double kLargestPlace = 80000;

struct RoomPlan {
  std::string name;
  std::string kind = "room";        ///< "kitchen", "corridor", ...
  std::string number;               ///< as on its sign
  Ring outline;                     ///< outline of its free inside, in any sense of rotation [m]
  double floor_z = 0;               ///< at the first corner [m]
  double height = 2.6;              ///< [m]
  double slope_x = 0, slope_y = 0;  ///< rise per metre along x and y of the map
  bool is_outdoors = false;         ///< class Outdoors: a ground without walls and ceiling
  std::string wall = "paint_white", floor = "wood_floor", ceiling = "ceiling_white";  ///< names of materials
};

struct OpeningPlan {
  enum class Kind { door, passage, window };
  enum class Leaf { none, open, closed };
  std::string name;
  Kind kind = Kind::door;
  std::vector<std::string> rooms;  ///< the two rooms that it joins; "outside" may be the second
  double x = 0, y = 0;             ///< a point near its middle; the nearest wall between the rooms counts [m]
  double width = 0.9;              ///< [m]; 0, for a passage: all that the two rooms share
  double height = 2.05, sill = 0;  ///< of the opening itself, and of its bottom above the floor [m]
  Leaf leaf = Leaf::open;          ///< of a door
  double leaf_angle = 1.6;         ///< angle by which an open leaf is turned into the first room [rad]
  bool hinge_right = false;        ///< seen from the first room
  std::string material = "door_wood";
};

struct PlacePlan {
  double x = 0, y = 0;  ///< [m]
  double yaw = 0;       ///< [rad]
  std::string on;       ///< the level surface it stands on, "table_1/top" or "box_1/top"; empty: the floor
};

/// A move of an object or marker at `time`: to another place or out of the world.
struct MovePlan {
  double time = 0;  ///< [s]
  std::optional<PlacePlan> place;
  std::string person = {};  ///< the person who carries it by hand; empty: it is there at once
};

/// Frame: origin in the middle of its outline on the floor, x along its length, the front faces -y.
struct FurniturePlan {
  std::string name;
  std::string shape;                         ///< one of furnitureShapes()
  double x = 0, y = 0, z = 0;                ///< z above the floor [m]
  double yaw = 0;                            ///< [rad]
  double length = 0, width = 0, height = 0;  ///< 0: as is usual for the shape [m]
  int boards = 0;                            ///< of a shelf; 0: as is usual, such as one for every 0.35 m
  std::string material;                      ///< empty: as is usual
};

struct ObjectPlan {
  std::string name;
  std::string shape;  ///< one of objectShapes()
  PlacePlan place;
  double length = 0, width = 0, height = 0;  ///< all 0: as is usual [m]
  bool moveable = true;
  std::string touching;         ///< object of the same support that it is slid against at the start; empty: none
  std::vector<MovePlan> moves;  ///< in order
};

/// The place of something that hangs on a wall. It hangs on the nearest wall, within 0.5 m, of the room that the point
/// lies in.
struct OnWallPlan {
  double x = 0, y = 0;  ///< [m]
  double z = 1.5;       ///< of its middle above the floor [m]
};

struct SignPlan {
  std::string name;
  std::string room;                ///< the room it names
  std::vector<std::string> lines;  ///< its text; empty: number and name of the room
  std::string style = "dark";      ///< of the building's signs: one of signStyleNames()
  OnWallPlan at;
  double width = 0, height = 0;  ///< 0: as its text needs [m]
};

struct PosterPlan {
  std::string name;
  std::string kind = "poster";  ///< one of posterKindNames()
  OnWallPlan at;
  double width = 0, height = 0;  ///< 0: as is usual [m]
};

/// A marker on a wall, or in a frame that stands on `place.on` or on the floor and faces -y at yaw 0.
struct MarkerPlan {
  std::string name;
  int id = 0;
  double side = 0.16;  ///< of the black square [m]
  bool on_wall = true;
  OnWallPlan at;
  PlacePlan place;
  std::vector<MovePlan> moves;
  bool is_landmark = false;  ///< a range-bearing sensor measures its middle, with the same id
};

struct LandmarkPlan {
  std::string name;
  int id = 0;
  double x = 0, y = 0, z = 0;  ///< [m]
};

/// An object that a person takes by hand, carries and puts down.
struct CarryPlan {
  std::string person;         ///< section of the person
  double begin = 0, end = 0;  ///< times at which it is taken and put down [s]
  std::string object;
  PlacePlan to;
};

/// A person who accompanies the robot. The path of such a person follows from the drive of the robot, which is planned
/// first.
struct CompanionPlan {
  enum class Place {
    ahead,     ///< on the robot's path, a distance ahead of it
    behind,    ///< on the robot's path, a distance behind it
    beside,    ///< beside the robot
    crossing,  ///< ahead on one side of the path; changes the side now and then
    stops,     ///< leads the robot: walks farther ahead now and then, mostly to a door, and waits there for the robot
  };
  std::string name;
  double height = 1.72;  ///< [m]
  std::uint64_t seed = 0;
  Place place = Place::ahead;
  double distance = 1;  ///< from the robot along its path; not for the place beside [m]
  double side = 0;      ///< offset to the left of the path; 0, for beside and crossing: as is usual [m]
  double from = 0,
         until = 0;  ///< before and after, the person stands where it is then; until 0: as long as it drives [s]
};

struct WorldPlan {
  std::string file;  ///< the INI that it is from, for messages
  std::uint64_t seed = 0;
  double wear = 0;  ///< as World::wear
  std::vector<RoomPlan> rooms;
  std::vector<OpeningPlan> openings;
  std::vector<FurniturePlan> furniture;
  std::vector<ObjectPlan> objects;
  std::vector<SignPlan> signs;
  std::vector<PosterPlan> posters;
  std::vector<MarkerPlan> markers;
  std::vector<LandmarkPlan> landmarks;
  std::vector<PersonSpec> people;         ///< a target that has a name needs no position; its position is looked up
  std::vector<CarryPlan> carryings;       ///< by people of these
  std::vector<CompanionPlan> companions;  ///< makeWorld() only checks their names, since they need the robot's drive
};

/// Builds the described world. Throws base::Error(out_of_range) naming section and key if that is impossible.
World makeWorld(const WorldPlan& plan);

/// Throws base::Error(out_of_range): "<file>: [<section>] <key>: <what>".
[[noreturn]] void refuse(const WorldPlan& plan, const std::string& section, const std::string& key,
                         const std::string& what);

}  // namespace omnimapper::sim

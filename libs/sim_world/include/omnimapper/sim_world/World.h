#pragma once

#include <omnimapper/sim_world/Body.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::sim {

/// A room or a stretch of corridor as people name it.
struct Room {
  std::string name;                      ///< "kitchen"
  std::string kind;                      ///< "kitchen", "office", "corridor", ...
  std::string number;                    ///< "118", or empty
  std::vector<Eigen::Vector2d> outline;  ///< of the room's free inside, counter-clockwise [m]
  /// z of the floor at outline.front(), and height of the ceiling above the floor [m].
  double floor_z = 0, height = 2.6;
  Eigen::Vector2d slope{0, 0};  ///< how much floor and ceiling rise per metre along x and y of the map
  bool is_outdoors = false;     ///< no walls, no ceiling

  double floorAt(const Eigen::Vector2d& in_map) const { return floor_z + slope.dot(in_map - outline.front()); }
};

/// A door sign. Its frame: x to the reader's right, y up, z out of the wall to the reader; origin at its middle.
struct Sign {
  std::string name;                ///< name of the sign, of its body and of its surface
  std::vector<std::string> lines;  ///< its text, as written on it
  std::string room;                ///< the room it names
  geometry::Se3 map_from_sign;
  double width = 0, height = 0;       ///< [m]
  std::vector<double> capitals = {};  ///< height of a capital letter of each line [m]
};

/// A square marker of a dictionary (ArUco). Its body's frame is as Sign's.
struct Marker {
  std::string name;  ///< of its body
  int id = 0;
  double side = 0;  ///< of the black square [m]
};

/// A point that a range-bearing sensor measures.
struct PointLandmark {
  std::string name;
  int id = 0;
  Eigen::Vector3d in_body = Eigen::Vector3d::Zero();
  std::string body;  ///< the body it is fixed to; empty: it is fixed to the map, and in_body is in the map
};

/// An object that people may put elsewhere: a cup, a box, ... Its poses over time are its body's track.
struct Object {
  std::string name;   ///< of its body
  std::string shape;  ///< "cup", "box", ...
  bool moveable = false;
  /// What it stands on from a time on: a surface ("table_1/top", "kitchen/floor", "box_1/top"), the person who carries
  /// it by hand, or nothing while it is away.
  struct Stand {
    double from = 0;  ///< [s]
    std::string on;
  };
  std::vector<Stand> stands = {};
};

/// A person: several bodies that move, and the joints a skeleton tracker would see.
struct Person {
  /// A joint as mrpt::obs::CObservationSkeleton names it: "head", "left_hand", ...
  struct Joint {
    std::string name;
    Track in_map;  ///< only its translation counts
  };
  /// One act of pointing: from `begin` to `end` [s] one arm points at the target.
  struct Pointing {
    double begin = 0, end = 0;
    std::string target;  ///< name of the surface or object, or empty
    Eigen::Vector3d target_in_map = Eigen::Vector3d::Zero();
    bool right_arm = true;
  };
  std::string name;
  std::vector<std::string> bodies;
  std::vector<Joint> joints;
  std::vector<Pointing> pointing;
  bool accompanies = false;  ///< its path follows from that of the robot
};

/// The joint of this name. Throws std::invalid_argument if the person has no such joint.
const Person::Joint& jointOf(const Person& person, const std::string& name);

/// The whole simulated world, in the map's frame: z up, floor of the first room at 0. Times are seconds since the
/// start.
struct World {
  std::uint64_t seed = 0;
  /// Variation of brightness from place to place on bodies that never move: standard deviation of the brightness
  /// divided by its mean.
  double wear = 0;
  std::vector<Body> bodies;
  std::vector<Room> rooms;
  std::vector<surfaces::Opening> openings;
  std::vector<Sign> signs;
  std::vector<Marker> markers;
  std::vector<PointLandmark> point_landmarks;
  std::vector<Object> objects;
  std::vector<Person> people;
  /// Areas where no robot can be [m]: the outlines on the floor of all that stands there at any time. The
  /// outlines of a wall are as thick as the wall and leave out its passages.
  std::vector<std::vector<Eigen::Vector2d>> obstacles;
};

/// A surface of a body. The label of a pixel or beam is the number of its surface in the world plus one; 0 is no
/// surface.
struct SurfaceRef {
  int body = 0, surface = 0;
};
/// All surfaces, in the order of the bodies and of the surfaces in each body. The index of a surface is its number in
/// the world.
std::vector<SurfaceRef> numberSurfaces(const World& world);

/// Throws base::Error(internal) unless names are unique and all references inside the world are valid.
void validate(const World& world);

}  // namespace omnimapper::sim

#pragma once

#include <omnimapper/sim/Footprint.h>
#include <omnimapper/sim/World.h>
#include <omnimapper/sim/WorldPlan.h>

#include <optional>
#include <vector>

namespace omnimapper::sim {

/// One flat side of a wall, as who stands in its room sees it: u runs from the left end to the right, z up.
struct WallFace {
  /// Where an opening goes through.
  struct Hole {
    double low_u = 0, high_u = 0;  ///< [m]
    double low_z = 0, high_z = 0;  ///< in the map [m]
    bool is_from_floor = true;     ///< its bottom is the floor, whatever low_z
  };
  int room = 0;
  std::string surface;                        ///< its name, "kitchen/wall_2"
  Eigen::Vector2d start, direction;           ///< in the map; direction is unit
  double length = 0;                          ///< [m]
  double floor_start = 0, floor_end = 0;      ///< z of the floor at both ends [m]
  double ceiling_start = 0, ceiling_end = 0;  ///< the same of the ceiling [m]
  std::vector<Hole> holes;                    ///< in order of u
  double solid = 0.3;                         ///< thickness of the wall behind it [m]

  Eigen::Vector2d inward() const { return {direction.y(), -direction.x()}; }  ///< into the room
  Eigen::Vector2d end() const { return start + length * direction; }
  double alongOf(const Eigen::Vector2d& in_map) const { return direction.dot(in_map - start); }
  /// In front of the wall positive, in its solid negative [m].
  double distanceTo(const Eigen::Vector2d& in_map) const { return inward().dot(in_map - start); }
  double floorAt(double u) const { return floor_start + (floor_end - floor_start) * u / length; }
  double ceilingAt(double u) const { return ceiling_start + (ceiling_end - ceiling_start) * u / length; }
  Eigen::Vector3d at(double u, double z) const;
};

/// Rooms with walls, floors and ceilings, and the openings between them.
struct Building {
  std::vector<Room> rooms;
  std::vector<WallFace> walls;
  std::vector<Body> bodies;          ///< of each room, then of each opening and its leaf
  std::vector<Ring> obstacles;       ///< solid of the walls and leaves, on the floor
  std::vector<Footprint> furniture;  ///< leaves of doors, for who looks for free floor
  std::vector<Ring> doorways;        ///< floor before and behind each opening that people walk through
};

/// Number of the room that a point of the map lies in.
std::optional<int> roomAt(const std::vector<Room>& rooms, const Eigen::Vector2d& in_map);

/// Throws base::Error(out_of_range) for rooms that overlap or touch without a passage, and openings without a wall.
Building makeBuilding(const WorldPlan& plan);

/// The steps of makeBuilding(). `walls` of rooms without openings yet, and an opening once it has found its walls.
struct FittedOpening {
  const OpeningPlan* plan = nullptr;
  int wall = -1, other_wall = -1;  ///< other_wall -1: the outside
  double low_u = 0, high_u = 0;    ///< on `wall` [m]
  double low_z = 0, high_z = 0;    ///< in the map [m]
  double depth = 0;                ///< thickness of the wall; 0: the rooms touch [m]
};
std::vector<WallFace> makeWalls(const WorldPlan& plan, const std::vector<Room>& rooms);
FittedOpening fitOpening(const WorldPlan& plan, const OpeningPlan& opening, const std::vector<Room>& rooms,
                         const std::vector<WallFace>& walls);
void addOpening(const FittedOpening& opening, const std::vector<WallFace>& walls, Building& building);

}  // namespace omnimapper::sim

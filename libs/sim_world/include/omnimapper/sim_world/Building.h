#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/WallFace.h>
#include <omnimapper/sim_world/World.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <optional>
#include <vector>

namespace omnimapper::sim {

/// Rooms with walls, floors and ceilings, and the openings between them.
struct Building {
  std::vector<Room> rooms;
  std::vector<WallFace> walls;
  std::vector<Body> bodies;  ///< of each room, then of each opening and its leaf
  std::vector<surfaces::Opening> openings;
  std::vector<Ring> obstacles;       ///< outlines on the floor of solid walls and of door leaves
  std::vector<Footprint> furniture;  ///< leaves of doors, which take up floor like furniture
  std::vector<Ring> doorways;        ///< floor before and behind each opening that people walk through
};

/// Number of the room that a point of the map lies in.
std::optional<int> roomAt(const std::vector<Room>& rooms, const Eigen::Vector2d& in_map);

/// Throws base::Error(out_of_range) for rooms that overlap or touch without a passage, and openings without a wall.
Building makeBuilding(const WorldPlan& plan);

}  // namespace omnimapper::sim

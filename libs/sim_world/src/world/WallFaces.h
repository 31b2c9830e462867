#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/WallFace.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <optional>

namespace omnimapper::sim {

constexpr double kSamePlace = 1e-9;  // [m]

/// The walls of rooms, without openings yet.
std::vector<WallFace> makeWalls(const std::vector<Room>& rooms);

/// The interval in which two walls face each other across the solid between their rooms.
struct Facing {
  double gap = 0;                ///< thickness of the solid [m]
  double low_u = 0, high_u = 0;  ///< interval that they share, in u of the first wall [m]
};
std::optional<Facing> facing(const WallFace& a, const WallFace& b);

/// The parts of a face between openings that reach from floor to ceiling.
std::vector<WallFace> withoutGaps(const WallFace& wall);

/// Joins faces that look like one wall, though they bound several rooms that are open to each other.
std::vector<WallFace> joined(const WorldPlan& plan, std::vector<WallFace> walls);

/// Outline of a wall in its u and z, without the openings that begin at the floor.
Ring outlineOf(const WallFace& wall);

}  // namespace omnimapper::sim

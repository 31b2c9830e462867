#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/WallFace.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <optional>

namespace omnimapper::sim {

constexpr double kSamePlace = 1e-9;  // [m]

/// The walls of rooms, without openings yet.
std::vector<WallFace> makeWalls(const std::vector<Room>& rooms);

/// Where two walls look at each other across the solid between their rooms.
struct Facing {
  double gap = 0;                ///< how thick it is [m]
  double low_u = 0, high_u = 0;  ///< what they share, in the first one's u [m]
};
std::optional<Facing> facing(const WallFace& a, const WallFace& b);

/// The parts of a face between what is open from floor to ceiling.
std::vector<WallFace> withoutGaps(const WallFace& wall);

/// What is one wall to the eye is one face, though it bounds several rooms that are open to each other.
std::vector<WallFace> joined(const WorldPlan& plan, std::vector<WallFace> walls);

/// In u and z of the wall, openings from the floor left out.
Ring outlineOf(const WallFace& wall);

}  // namespace omnimapper::sim

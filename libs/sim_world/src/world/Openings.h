#pragma once

#include <omnimapper/sim_world/Building.h>

namespace omnimapper::sim {

/// An opening with the walls that it goes through.
struct FittedOpening {
  const OpeningPlan* plan = nullptr;
  int wall = -1, other_wall = -1;  ///< other_wall -1: the outside
  double low_u = 0, high_u = 0;    ///< on `wall` [m]
  double low_z = 0, high_z = 0;    ///< in the map [m]
  double depth = 0;                ///< thickness of the wall; 0: the rooms touch [m]
};

/// Throws base::Error(out_of_range) for an opening without a wall, or one that does not fit into it.
FittedOpening fitOpening(const WorldPlan& plan, const OpeningPlan& opening, const std::vector<Room>& rooms,
                         const std::vector<WallFace>& walls);

/// Adds the frame, pane, leaf and doorway of an opening; `walls` are those it was fitted to.
void addOpening(const FittedOpening& opening, const std::vector<WallFace>& walls, Building& building);

}  // namespace omnimapper::sim

#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/World.h>

#include <vector>

namespace omnimapper::sim {

/// Where in a room a robot of 0.33 m may be, on a grid of 0.1 m.
class RoomWays {
 public:
  RoomWays(const Room& room, const std::vector<Ring>& doorways);

  /// Something stands there.
  void block(const Ring& ring);
  /// Whether the robot comes from each doorway of the room to all others, and to nearly all free floor.
  bool areOpen() const;

 private:
  enum Cell : char { wall, inside, door, seen };
  Eigen::Vector2d middleOf(int cell) const;
  void mark(const Ring& ring, double distance, Cell from, Cell to);
  std::size_t markReached(int start, std::vector<Cell>& cells) const;

  Eigen::Vector2d low_;  // of the grid, in the map [m]
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace omnimapper::sim

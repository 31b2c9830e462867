#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/World.h>

#include <vector>

namespace omnimapper::sim {

/// The places in a room where a robot of radius 0.33 m may be, on a grid of 0.1 m.
class RoomPaths {
 public:
  RoomPaths(const Room& room, const std::vector<Ring>& doorways);

  /// Marks an area where something stands.
  void block(const Ring& ring);
  /// Whether the robot can get from each doorway of the room to all others, and to nearly all free floor.
  bool areOpen() const;

 private:
  enum Cell : char { wall, inside, door, visited };
  Eigen::Vector2d middleOf(int cell) const;
  void mark(const Ring& ring, double distance, Cell from, Cell to);
  std::size_t markReached(int start, std::vector<Cell>& cells) const;

  Eigen::Vector2d low_;  // lower corner of the grid, in the map [m]
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace omnimapper::sim

#pragma once

#include <omnimapper/matching/Relocalizer.h>

#include <cstddef>
#include <vector>

namespace omnimapper::matching {

/// When a place counts as a wall, and a beam as one that passes through it.
struct WallCrossingOptions {
  double cell = 0.1;          ///< [m] of the grid that walls are drawn in
  int min_scans = 5;          ///< that must have seen a wall in a cell
  double max_passed = 0.3;    ///< share of scans that pass through a cell: where more do, there is no wall, or no more
  double min_distance = 0.5;  ///< [m] from the wall on to the end of a beam that passed through it
  double max_incidence = 0.87;       ///< [rad] between beam and wall's normal: who looks along a wall does not cross it
  std::size_t max_cells = 64000000;  ///< a larger map is refused; 20 bytes for each cell with a wall, 4 for any other
};

/// What became of the beams of one scan that ended somewhere.
struct CrossedWalls {
  std::size_t beams = 0;    ///< that are finite and longer than min_distance
  std::size_t crossed = 0;  ///< of them, those that pass through a wall that others saw
};

struct WallCrossings {
  std::size_t walls = 0;            ///< cells with a wall
  std::vector<CrossedWalls> scans;  ///< one for each, in their order
};

/// How many beams of each scan pass through walls of the map that all scans together make. Where a map is bent, or two
/// places lie upon each other, many beams of some scans go where the map has walls; people, glass and doors let a few
/// beams of many scans through. Throws Error(out_of_range) for scans spread over more than max_cells.
WallCrossings crossedWalls(const std::vector<MapScan>& scans, const WallCrossingOptions& options = {});

}  // namespace omnimapper::matching

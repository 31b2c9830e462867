#pragma once

#include <omnimapper/matching/Relocalizer.h>

#include <cstddef>
#include <vector>

namespace omnimapper::matching {

/// Criteria for walls and for beams that pass through them.
struct WallCrossingOptions {
  double cell = 0.1;  ///< [m] cell of the grid of walls
  int min_scans = 5;  ///< smallest number of scans that saw a wall in a cell
  /// Largest share of scans that pass through the cell of a wall. If more pass, there is no wall, or the wall has gone.
  double max_passed = 0.3;
  double min_distance = 0.5;  ///< [m] smallest distance from a wall to the end of a beam that passed through it
  /// [rad] Largest angle between beam and wall normal: a beam along a wall does not cross it.
  double max_incidence = 0.87;
  std::size_t max_cells = 64000000;  ///< a larger map is refused; 20 bytes for each cell with a wall, 4 for any other
};

/// Counts of the beams of one scan that have an echo.
struct CrossedWalls {
  std::size_t beams = 0;    ///< finite beams that are longer than min_distance
  std::size_t crossed = 0;  ///< beams among these that pass through a wall that other scans saw
};

struct WallCrossings {
  std::size_t walls = 0;            ///< cells with a wall
  std::vector<CrossedWalls> scans;  ///< one for each scan, in their order
  std::vector<bool> steps;          ///< for each step of the track, whether it leads through a wall
};

/// A straight piece of the track, in the map [m].
struct TrackStep {
  Eigen::Vector2d from, to;
};

/// Counts how many beams of each scan pass through walls of the map that all scans together make. Where a map is
/// distorted, or two places overlap, many beams of some scans pass through walls of the map; people, glass and doors
/// let a few beams of many scans pass. No robot drives through a wall: a step of its `track` that does so was measured
/// wrongly, or the wall was. Throws Error(out_of_range) for scans spread over more than max_cells.
WallCrossings crossedWalls(const std::vector<MapScan>& scans, const WallCrossingOptions& options = {},
                           const std::vector<TrackStep>& track = {});

}  // namespace omnimapper::matching

#pragma once

#include <omnimapper/derived/ScanGrid.h>
#include <omnimapper/geometry/Segment2.h>
#include <omnimapper/map/KeyFrames.h>

#include <optional>
#include <utility>
#include <vector>

namespace omnimapper::plugins {

/// Whether something stands along a line on the floor, by the occupancy grid of the map and the way of the base. Legs
/// of chairs and tables in one line are no wall: beams pass between them. What the base drove through is no wall
/// either.
class LineSupport {
 public:
  /// Both must outlive it. The grid must be of the same map.
  LineSupport(const derived::ScanGrid& grid, const map::KeyFrames& key_frames)
      : grid_(&grid), key_frames_(&key_frames) {}

  /// A part of a line by the distances of its ends from the line's begin [m].
  using Stretch = std::pair<double, double>;

  /// The stretches of a line [m, map], in order, on which something stands: at least 0.5 m long, with no gap of 0.3 m
  /// that beams passed, and with occupied cells within 0.15 m of at least half of what was seen. Parts that were not
  /// seen are in the stretch between whose seen parts they lie. None if the grid has seen nothing of the line.
  std::optional<std::vector<Stretch>> stretchesOf(const geometry::Segment2& line) const;

 private:
  const derived::ScanGrid* grid_;
  const map::KeyFrames* key_frames_;
};

}  // namespace omnimapper::plugins

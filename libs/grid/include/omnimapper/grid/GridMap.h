#pragma once

#include <omnimapper/geometry/Se2.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::grid {

enum class GridCell : std::uint8_t { unknown, free, occupied };

/// An occupancy grid at a place of a map. Row 0 is at the smallest y of the grid's own frame [m], whose origin is the
/// outer corner of cell (0, 0).
struct GridMap {
  int columns = 0, rows = 0;
  double resolution = 0;  ///< [m] side of a cell
  geometry::Se2 map_from_grid;
  std::vector<GridCell> cells;  ///< row by row

  bool contains(const Eigen::Vector2i& cell) const {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < columns && cell.y() < rows;
  }
  std::size_t indexOf(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(cell.x());
  }
  /// Cells outside the grid are unknown.
  GridCell at(const Eigen::Vector2i& cell) const { return contains(cell) ? cells[indexOf(cell)] : GridCell::unknown; }
  /// The cell that contains a point of the map; for points too far away for an integer, a cell far outside the grid.
  Eigen::Vector2i cellOf(const Eigen::Vector2d& point) const;
  /// The middle of a cell, in the map.
  Eigen::Vector2d middleOf(const Eigen::Vector2i& cell) const;
};

/// Reads a grid of ROS map_server: a YAML file and the image that it names (binary PGM of 8 bits, or PNG), whose path
/// is relative to the folder of the YAML file. The keys mode (trinary, scale, raw), negate, occupied_thresh,
/// free_thresh and origin (with yaw) mean what they mean to map_server; a probability between the thresholds is
/// unknown. Throws Error(unreadable_input), naming file and reason, if a file is missing, damaged or in another format,
/// or the grid has more than 400 million cells.
GridMap readGridMap(const std::string& yaml_file);

}  // namespace omnimapper::grid

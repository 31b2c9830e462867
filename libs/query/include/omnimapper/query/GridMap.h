#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::query {

enum class GridCell : std::uint8_t { unknown, free, occupied };

/// The occupancy grid of a map. Frame of the map [m]; row 0 is at the smallest y.
struct GridMap {
  int columns = 0, rows = 0;
  double resolution = 0;       ///< [m] side of a cell
  Eigen::Vector2d lower_left;  ///< corner of the first cell
  std::vector<GridCell> cells;

  bool contains(const Eigen::Vector2i& cell) const {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < columns && cell.y() < rows;
  }
  std::size_t indexOf(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(cell.x());
  }
  /// Cells outside the grid are unknown.
  GridCell at(const Eigen::Vector2i& cell) const { return contains(cell) ? cells[indexOf(cell)] : GridCell::unknown; }
  /// The cell that contains a point; for points too far away for an integer, a cell far outside the grid.
  Eigen::Vector2i cellOf(const Eigen::Vector2d& point) const;
  Eigen::Vector2d middleOf(const Eigen::Vector2i& cell) const;
};

/// Reads grid.yaml and the 8-bit binary PGM that it names from a map's folder, in the format of ROS map_server (mode
/// trinary). Throws Error(unreadable_input), naming file, place and remedy, if a file is missing, damaged or in another
/// format, or the grid is rotated or larger than 400 million cells.
GridMap readGrid(const std::string& folder);

}  // namespace omnimapper::query

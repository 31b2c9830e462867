#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/View.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::derived {

/// Options for building an occupancy grid from the scans of a map.
struct ScanGridOptions {
  double resolution = 0.05;  ///< [m] side of a cell
  double max_range = 30.0;   ///< [m] beams are entered up to this length
  double margin = 0.5;       ///< [m] width of unknown cells around the observed area
  double max_cells = 40e6;   ///< limit including the margin; a larger extent gets coarser cells
};

enum class Cell : std::uint8_t { unknown, free, occupied };

/// A top-down occupancy grid of the map's z = 0 plane.
struct ScanGrid {
  int columns = 0, rows = 0;
  double resolution = 0;        ///< [m]
  double min_x = 0, min_y = 0;  ///< [m] outer corner of the cell (0, 0)
  std::vector<Cell> cells;      ///< row by row, row 0 at min_y

  Cell at(int column, int row) const { return cells[static_cast<std::size_t>(row) * columns + column]; }
  double maxX() const { return min_x + columns * resolution; }
  double maxY() const { return min_y + rows * resolution; }
};

/// The grid of all 2D scans of the key frames, with free space traced along the beams; none if no scan has a valid
/// beam. Scans tilted by more than 10 deg are left out. The resolution is doubled until the grid has at most max_cells.
std::optional<ScanGrid> buildScanGrid(const map::Map& map, const ScanGridOptions& options);

/// The grid of the whole map, as buildScanGrid(); outputs of one finished map share it (View::shared).
std::shared_ptr<const std::optional<ScanGrid>> scanGridOf(const mapper::View& view, const ScanGridOptions& options);

}  // namespace omnimapper::derived

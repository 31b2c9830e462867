#include "GridOfRun.h"

#include <omnimapper/building/DrivenWay.h>

namespace omnimapper::plugins {

grid::GridMap gridMapOf(const derived::ScanGrid& grid) {
  grid::GridMap map;
  map.columns = grid.columns;
  map.rows = grid.rows;
  map.resolution = grid.resolution;
  map.map_from_grid = {grid.min_x, grid.min_y, 0};
  map.cells.reserve(grid.cells.size());
  for (const derived::Cell cell : grid.cells)
    map.cells.push_back(cell == derived::Cell::free       ? grid::GridCell::free
                        : cell == derived::Cell::occupied ? grid::GridCell::occupied
                                                          : grid::GridCell::unknown);
  return map;
}

grid::GridMap withDrivenWay(grid::GridMap grid, const map::Map& map, double radius) {
  std::vector<Eigen::Vector2d> way;
  for (const auto& frame : map.key_frames) {
    const Eigen::Vector2d at(frame.map_from_base.x(), frame.map_from_base.y());
    way.push_back(at);
  }
  building::freeDrivenWay(grid, way, radius);
  return grid;
}

}  // namespace omnimapper::plugins

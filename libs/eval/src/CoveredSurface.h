#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// A grid on the plane of a surface that covers the points `corners`. Throws Error(unreadable_input) that names the
/// surface.
inline surfaces::CellGrid gridAround(const surfaces::Surface& surface, const std::vector<Eigen::Vector3d>& corners,
                                     double cell) {
  try {
    return surfaces::CellGrid::around(surface.plane, corners, cell);
  } catch (const std::invalid_argument& error) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "surface '" + surface.name + "': " + error.what() + ", because it reaches too far");
  }
}

/// Calls use(middle of the cell, cell) for each cell that is set.
template <class Use>
void forEachSetCell(const surfaces::CellGrid& grid, const Use& use) {
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column)
      if (grid.isSet({column, row})) use(grid.middleOf({column, row}), surfaces::CellGrid::Cell{column, row});
}

/// A surface with the cells that its outlines cover. The surface must outlive it.
struct CoveredSurface {
  const surfaces::Surface* surface = nullptr;
  surfaces::CellGrid cells;
  Eigen::AlignedBox3d box;

  CoveredSurface(const surfaces::Surface& of, double cell) : surface(&of), cells(gridAround(of, cornersOf(of), cell)) {
    for (const auto& part : of.parts) cells.fill(part.outline, part.holes);
    for (const auto& corner : cornersOf(of)) box.extend(corner);
  }
  /// The surface with the cells that were seen; with all cells if it has no `seen`.
  static CoveredSurface bySeen(const surfaces::Surface& of, double cell) {
    CoveredSurface covered(of, cell);
    if (!of.seen) return covered;
    covered.cells = *of.seen;
    covered.box.setEmpty();
    covered.forEach([&](const Eigen::Vector3d& middle, surfaces::CellGrid::Cell) { covered.box.extend(middle); });
    return covered;
  }
  template <class Use>
  void forEach(const Use& use) const {
    forEachSetCell(cells, use);
  }
  bool contains(const Eigen::Vector3d& point) const {
    const auto cell = cells.cellAt(point);
    return cell && cells.isSet(*cell);
  }
};

/// Whether a part of one may lie on the other, by their normals and bounding boxes.
inline bool mayMeet(const CoveredSurface& a, const CoveredSurface& b, const MapQualityOptions& options) {
  if (a.surface->plane.normal.dot(b.surface->plane.normal) < std::cos(options.max_turn)) return false;
  return a.box.exteriorDistance(b.box) <= options.max_distance;
}

}  // namespace omnimapper::eval

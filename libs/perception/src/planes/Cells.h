#pragma once

#include <omnimapper/camera/DepthNoise.h>

#include <vector>

#include "InverseDepth.h"
#include "PlaneMoments.h"

namespace omnimapper::perception::planes {

struct Cell {
  PlaneMoments moments;  ///< of its measured pixels, counted from the principal point
  double squares = 0;    ///< sum of squared residuals from its own plane [1/m^2]
  bool flat = false;     ///< whether one plane explains its pixels
};

struct CellGrid {
  int columns = 0, rows = 0;
  std::vector<Cell> cells;

  int index(int column, int row) const { return row * columns + column; }
  const Cell& at(int column, int row) const { return cells[static_cast<std::size_t>(index(column, row))]; }
};

/// Divides the image into cells of kCell x kCell pixels and fits a plane to each.
CellGrid fitCells(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise);

}  // namespace omnimapper::perception::planes

#pragma once

#include <vector>

#include "Cells.h"

namespace omnimapper::perception::planes {

constexpr int kNoRegion = -1;

/// Regions of cells that lie on one plane.
struct CellRegions {
  struct Region {
    PlaneMoments moments;
    ImagePlane plane;
  };
  std::vector<int> of_cell;  ///< index of its region, or kNoRegion
  std::vector<Region> regions;
};

/// Largest sum of squares [1/m^2] by which a shared plane may fit the n pixels of a cell worse than the cell's own
/// plane does: noise of the three plane parameters, plus a systematic distortion [1/m] of all n pixels.
double excessAllowed(const camera::DepthNoise& noise, double n, double distortion);

/// Grows regions from the flattest blocks of cells. A cell joins if it is near the plane of the cells before it.
CellRegions growRegions(const CellGrid& grid, const camera::DepthNoise& noise);

/// Merges adjacent regions that one plane explains, and drops regions that turn out curved.
CellRegions mergeRegions(const CellGrid& grid, const camera::DepthNoise& noise, CellRegions grown);

}  // namespace omnimapper::perception::planes

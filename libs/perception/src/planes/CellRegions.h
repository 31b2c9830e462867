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

/// By how much a plane of others may explain n pixels of a cell worse than their own does [1/m^2 squared]: noise of the
/// cell's three parameters, and flat walls that seem bent by `bend` [1/m].
double excessAllowed(const DepthNoise& noise, double n, double bend);

/// Grows regions from the flattest blocks of cells. Each cell that joins is near the plane of those before it.
CellRegions growRegions(const CellGrid& grid, const DepthNoise& noise);

/// Joins regions that meet where one plane explains both, and drops those that turn out curved.
CellRegions mergeRegions(const CellGrid& grid, const DepthNoise& noise, CellRegions grown);

}  // namespace omnimapper::perception::planes

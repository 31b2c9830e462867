#pragma once

#include "CellRegions.h"

namespace omnimapper::perception::planes {

/// Drops regions of a few cells whose pixels lie on the planes of larger regions around them: cells over an edge can
/// look like a plane of their own.
CellRegions dropExplained(const InverseDepth& inverse, const Pinhole& camera, const DepthNoise& noise,
                          const CellGrid& grid, CellRegions regions);

}  // namespace omnimapper::perception::planes

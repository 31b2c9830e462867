#pragma once

#include "CellRegions.h"

namespace omnimapper::perception::planes {

/// Drops regions of a few cells whose pixels lie on the planes of larger regions around them: cells across an edge can
/// look like a separate plane.
CellRegions dropExplained(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
                          const CellGrid& grid, CellRegions regions);

}  // namespace omnimapper::perception::planes

#pragma once

#include <cstdint>
#include <vector>

#include "CellRegions.h"

namespace omnimapper::perception::planes {

/// A label for each pixel of an InverseDepth, its padding included: index of a region + 1, or 0 for none.
struct PixelLabels {
  int stride = 0, rows = 0;
  std::vector<std::uint16_t> values;
};

/// Assigns each pixel to the plane it fits, among those of its own cell and the cells around it (thesis 3.4.4: planes
/// grow to where they end). Where two planes cross, the pixels are divided by the line of intersection, not by noise
/// or by the sensor's quantization steps.
PixelLabels labelPixels(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
                        const CellGrid& grid, const CellRegions& regions);

}  // namespace omnimapper::perception::planes

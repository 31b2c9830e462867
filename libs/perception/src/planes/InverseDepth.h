#pragma once

#include <omnimapper/perception/DepthImage.h>

#include <memory>

namespace omnimapper::perception::planes {

/// Side of the cells the image is cut into [px].
constexpr int kCell = 16;

/// 1/z [1/m] of each pixel, 0 where nothing was measured, with columns and rows of zeros up to whole cells, and eight
/// zeros behind.
struct InverseDepth {
  int width = 0, height = 0;
  int stride = 0;  ///< of a row, a multiple of kCell
  int rows = 0;    ///< a multiple of kCell
  std::unique_ptr<float[]> values;

  const float* at(int x, int y) const { return values.get() + static_cast<std::ptrdiff_t>(y) * stride + x; }
};

/// Depths outside [min_depth, max_depth] [m] are no measurement.
InverseDepth invert(const DepthImage& image, double min_depth, double max_depth);

}  // namespace omnimapper::perception::planes

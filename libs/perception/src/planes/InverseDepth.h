#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <memory>

namespace omnimapper::perception::planes {

/// Side of the cells the image is cut into [px].
constexpr int kCell = 16;

/// Inverse depth 1/z [1/m] of each pixel, 0 where nothing was measured. Columns and rows are padded with zeros to whole
/// cells, and eight zeros follow the last row.
struct InverseDepth {
  int width = 0, height = 0;
  int stride = 0;  ///< values per row, a multiple of kCell
  int rows = 0;    ///< a multiple of kCell
  std::unique_ptr<float[]> values;

  const float* at(int x, int y) const { return values.get() + static_cast<std::ptrdiff_t>(y) * stride + x; }
};

/// Depths outside [min_depth, max_depth] [m] count as not measured.
InverseDepth invert(const camera::DepthImage& image, double min_depth, double max_depth);

}  // namespace omnimapper::perception::planes

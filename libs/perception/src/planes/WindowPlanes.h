#pragma once

#include <omnimapper/camera/DepthImage.h>

#include "InverseDepth.h"

namespace omnimapper::perception::planes {

/// Output arrays for the unit normals of a row of pixels.
struct NormalRow {
  float* x;
  float* y;
  float* z;
};

/// Planes fitted to the square windows around the pixels of an image, row by row from the top.
/// Inverse depths are rounded to whole numbers of 15 bits. All sums over windows stay below 2^24 for a radius up to 7,
/// so that they are exact in single precision, in any order of summation, and sliding windows accumulate no error.
class WindowPlanes {
 public:
  /// `highest` [1/m]: the largest inverse depth. `tolerance` [1/m]: how far the pixels of a window may be from its
  /// plane.
  WindowPlanes(const InverseDepth& inverse, const camera::Pinhole& camera, int radius, double highest,
               double tolerance);

  /// Writes the normals of the next row, NaN where the window is not fully measured or not flat. Images narrower than
  /// the window plus seven pixels have none.
  void next(const NormalRow& to);

 private:
  void slide();
  const float* row(int y) const { return whole_.get() + static_cast<std::ptrdiff_t>(y) * stride_; }

  int width_, stride_, rows_, radius_, y_ = 0;
  camera::Pinhole camera_;
  float tolerance_;
  std::unique_ptr<float[]> whole_;  // inverse depths, scaled and rounded to whole numbers
  // Sums over the rows of the window for each column: unmeasured pixels, values, values times their row.
  std::unique_ptr<float[]> missing_, sum_, moment_;
};

}  // namespace omnimapper::perception::planes

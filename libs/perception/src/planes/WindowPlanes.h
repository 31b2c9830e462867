#pragma once

#include <omnimapper/perception/DepthImage.h>

#include "InverseDepth.h"

namespace omnimapper::perception::planes {

/// Where the unit normals of a row of pixels go.
struct NormalRow {
  float* x;
  float* y;
  float* z;
};

/// Planes fitted to the square windows around the pixels of an image, row by row from the top.
/// Inverse depths are rounded to whole numbers of 15 bits. All sums over windows stay below 2^24 for a radius up to 7,
/// so that they are exact in single precision, however they are added up, and sliding windows gather no error.
class WindowPlanes {
 public:
  /// `tolerance` [1/m]: how far the pixels of a window may be from its plane.
  WindowPlanes(const InverseDepth& inverse, const Pinhole& camera, int radius, double highest, double tolerance);

  /// Normals of the next row; not a number where the window is not wholly measured or not flat. Images narrower than
  /// the window and seven pixels have none.
  void next(const NormalRow& to);

 private:
  void slide();
  const float* row(int y) const { return whole_.get() + static_cast<std::ptrdiff_t>(y) * stride_; }

  int width_, stride_, rows_, radius_, y_ = 0;
  Pinhole camera_;
  float tolerance_;
  std::unique_ptr<float[]> whole_;  // the image in whole numbers
  // Over the rows of the window, for each column: pixels that were not measured, values, values times their row.
  std::unique_ptr<float[]> missing_, sum_, moment_;
};

}  // namespace omnimapper::perception::planes

#pragma once

#include <omnimapper/camera/ColourImage.h>
#include <omnimapper/camera/DepthImage.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace omnimapper::matching {

struct RgbdPyramidOptions {
  int levels = 4;          ///< largest number of levels; each has half the columns and rows of the one before
  double min_depth = 0.2;  ///< [m]
  double max_depth = 12;   ///< [m]
};

/// One level of an image pyramid, in the order of pixels, row by row.
struct RgbdLevel {
  int width = 0, height = 0;
  camera::Pinhole camera;
  std::vector<float> inverse_depth;  ///< 1/z [1/m] in the optical frame; 0 where nothing was measured
  std::vector<float> grey;           ///< 0 to 255; empty without a picture

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// A depth image and the picture of the same view, in coarser and coarser levels. Depths are averaged as inverse
/// depths, in which a plane is linear, over pixels of one surface: at a depth discontinuity the nearer surface is kept.
class RgbdPyramid {
 public:
  /// `colour` may be null if there is no picture. Throws Error(unreadable_input) if the picture's size is not that of
  /// the depth image.
  RgbdPyramid(const camera::DepthImage& depth, const camera::ColourImage* colour,
              const RgbdPyramidOptions& options = {});

  /// From the finest to the coarsest; the coarsest has at least 20 columns and rows, unless the image has fewer.
  const std::vector<RgbdLevel>& levels() const { return levels_; }
  const RgbdLevel& finest() const { return levels_.front(); }
  /// Median depth of the coarsest level [m]; none if a tenth of its pixels or less have a depth.
  std::optional<double> medianDepth() const;
  bool hasPicture() const { return !levels_.front().grey.empty(); }

 private:
  std::vector<RgbdLevel> levels_;
};

}  // namespace omnimapper::matching

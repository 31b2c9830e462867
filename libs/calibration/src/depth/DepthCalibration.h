#pragma once

#include <omnimapper/base/Progress.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "DepthCells.h"
#include "DistortionFit.h"

namespace omnimapper::calibration {

/// How flat the planes of the images are that were held back.
struct HeldFlatness {
  double rms = 0;                    ///< [1/m] of all samples but the worst tenth
  std::vector<double> rms_of_image;  ///< the same of each image that shows a plane
  std::vector<FlatSample> misses;    ///< [1/m] by how much each sample is beyond its plane
};

struct DepthCalibration {
  DistortionFit fit;
  /// Root mean square over the image of the distortion, and of the difference between those that the first and the
  /// second half of the images give alone [1/m].
  double rms = 0, halves_differ_rms = 0;
  std::size_t images = 0, held_images = 0;    ///< held back: of `images`
  std::size_t patches = 0, held_patches = 0;  ///< planes: those of the estimate, and those held back
  int cell_pixels = 0;                        ///< a side of a cell
  double nearest = 0, farthest = 0;           ///< [m] between them are nine tenths of the samples
  HeldFlatness before, after;
  std::size_t flatter_images = 0;  ///< of before.rms_of_image
};

/// Throws Error(nothing_to_map), with the reason and the remedy, where the images do not tell it, and
/// Error(interrupted).
DepthCalibration calibrateDepth(const std::vector<DepthCells>& images, int degree, base::Progress& progress,
                                const std::function<bool()>& stop);

}  // namespace omnimapper::calibration

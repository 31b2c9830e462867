#pragma once

#include <omnimapper/base/Progress.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "DepthCells.h"
#include "DistortionFit.h"

namespace omnimapper::calibration {

/// Flatness of the planes in the held-back images.
struct HeldFlatness {
  double rms = 0;                    ///< [1/m] of all samples but the worst tenth
  std::vector<double> rms_of_image;  ///< [1/m] the same of each image that shows a plane
  std::vector<FlatSample> misses;    ///< [1/m] inverse depth of each sample minus that of its plane
};

struct DepthCalibration {
  DistortionFit fit;
  /// Root mean square over the image [1/m] of the distortion, and of the difference between the distortions that are
  /// estimated from the first and from the second half of the images.
  double rms = 0, halves_differ_rms = 0;
  std::size_t images = 0, held_images = 0;    ///< number of all images, and of those held back
  std::size_t patches = 0, held_patches = 0;  ///< number of planes of the estimate, and of those held back
  int cell_pixels = 0;                        ///< [px] side of a cell
  double nearest = 0, farthest = 0;           ///< [m] nine tenths of the samples are between them
  HeldFlatness before, after;
  std::size_t flatter_images = 0;  ///< number of held-back images that get flatter
};

/// Estimates the distortion from these images. Throws Error(nothing_to_map), with the reason and the remedy, if the
/// images do not determine it, and Error(interrupted).
DepthCalibration calibrateDepth(const std::vector<DepthCells>& images, int degree, base::Progress& progress,
                                const std::function<bool()>& stop);

}  // namespace omnimapper::calibration

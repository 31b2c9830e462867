#pragma once

#include <omnimapper/perception/DepthDistortion.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "DepthCells.h"

namespace omnimapper::calibration {

/// A cell of a patch, as the sensor told it.
struct FlatSample {
  double x, y;           ///< from -1 to 1 over the image
  double inverse_depth;  ///< [1/m]
};

/// What is likely one plane of an image.
struct FlatPatch {
  std::size_t image = 0;
  std::vector<FlatSample> samples;
};

/// The planes of an image, each grown over cells that are within `bound` [1/m] of it and about as steep; loose enough
/// that what the sensor bends stays one patch. `known` is what is known of the bending already. What is smaller than a
/// twenty-fifth of the image is left out.
std::vector<FlatPatch> growPatches(const DepthCells& image, const perception::DepthDistortion& known, double bound);

/// Least squares with a loss beyond `scale` [1/m]: the plane a + b x + c y through the samples corrected by `known`.
Eigen::Vector3d fitPlane(const FlatPatch& patch, const perception::DepthDistortion& known, double scale);
/// By how much the corrected samples are beyond that plane, in their order [1/m].
std::vector<double> missesOf(const FlatPatch& patch, const perception::DepthDistortion& known, double scale);

}  // namespace omnimapper::calibration

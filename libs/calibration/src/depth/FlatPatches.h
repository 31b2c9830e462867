#pragma once

#include <omnimapper/camera/DepthDistortion.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "DepthCells.h"

namespace omnimapper::calibration {

/// A cell of a patch, as the sensor measured it.
struct FlatSample {
  double x, y;           ///< from -1 to 1 over the image
  double inverse_depth;  ///< [1/m]
};

/// Cells of an image that are likely on one plane.
struct FlatPatch {
  std::size_t image = 0;
  std::vector<FlatSample> samples;
};

/// Grows planes in an image, each over cells that are within `bound` [1/m] of it and have about the same slope. `bound`
/// must be loose enough that a plane which the sensor distorts stays one patch. `known` is the distortion as far as it
/// is known. Patches that are smaller than a twenty-fifth of the image are left out.
std::vector<FlatPatch> growPatches(const DepthCells& image, const camera::DepthDistortion& known, double bound);

/// Fits the plane a + b x + c y to the samples corrected by `known`, by least squares with a loss beyond `scale` [1/m].
Eigen::Vector3d fitPlane(const FlatPatch& patch, const camera::DepthDistortion& known, double scale);
/// Inverse depths of the corrected samples minus those of that plane, in the order of the samples [1/m].
std::vector<double> missesOf(const FlatPatch& patch, const camera::DepthDistortion& known, double scale);

}  // namespace omnimapper::calibration

#pragma once

#include <cstdint>
#include <vector>

#include "../planes/PixelLabels.h"

namespace omnimapper::perception::road {

struct GrowthLimits {
  double sigma = 0;             ///< [1/m] standard deviation of a pixel
  double tolerance = 0;         ///< [1/m] of a pixel from the ground around it
  double step_sigmas = 0;       ///< see findHeightSteps
  double correlation_area = 1;  ///< [px^2] how many pixels share one error
  int radius = 0;               ///< [px] of the windows that pixels are averaged over
};

/// Labels of 1 for seeds, and for pixels within `tolerance` of the ground around them, by planes fitted to the seeds,
/// that are not barred; but for steps in its height, and for what is above that ground by more than as many deviations
/// on average over the window: a pixel of a wall is within the tolerance up to a dozen rows above its foot. `seeds` and
/// `barred` are of each pixel, row by row.
planes::PixelLabels growGround(const planes::InverseDepth& inverse, const Pinhole& camera,
                               const std::vector<std::uint8_t>& seeds, const std::vector<std::uint8_t>& barred,
                               const GrowthLimits& limits);

}  // namespace omnimapper::perception::road

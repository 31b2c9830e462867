#pragma once

#include <cstdint>
#include <vector>

#include "../planes/PixelLabels.h"

namespace omnimapper::perception::road {

struct GrowthLimits {
  double sigma = 0;             ///< [1/m] standard deviation of a pixel
  double tolerance = 0;         ///< [1/m] largest distance of a pixel from the ground around it
  double step_sigmas = 0;       ///< see findHeightSteps
  double correlation_area = 1;  ///< [px^2] number of pixels that share one error
  int radius = 0;               ///< [px] of the windows that pixels are averaged over
};

/// Grows the ground from its seeds. Labels are 1 for seeds, and for pixels within `tolerance` of the ground around them
/// (planes fitted to the seeds) that are not barred. They are 0 for steps in the ground's height, and for pixels
/// without a seed whose window is above that ground on average by as many standard deviations of its mean: a pixel of a
/// wall is within the tolerance up to a dozen rows above the wall's foot. `seeds` and `barred` have a value for each
/// pixel, row by row.
planes::PixelLabels growGround(const planes::InverseDepth& inverse, const camera::Pinhole& camera,
                               const std::vector<std::uint8_t>& seeds, const std::vector<std::uint8_t>& barred,
                               const GrowthLimits& limits);

}  // namespace omnimapper::perception::road

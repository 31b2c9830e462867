#pragma once

#include "PlaneMoments.h"

namespace omnimapper::perception::planes {

/// Sums over the pixels of a run of their residuals r from a plane [1/m] and depths z [m]; x counts from the run's
/// begin.
struct RunSums {
  double r = 0, xr = 0, rr = 0;
  double z = 0, xz = 0;
};

/// `values` are those of the run's pixels, all measured, and seven more that are read but not used; the plane is
/// `start` + `slope` x.
RunSums sumRun(const float* values, int n, float start, float slope);

/// Sum of (z r)^2 over the same: z r is by what part of its depth a pixel lies off the plane.
double sumRelativeSquares(const float* values, int n, float start, float slope);

}  // namespace omnimapper::perception::planes

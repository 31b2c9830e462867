#pragma once

#include "PlaneMoments.h"

namespace omnimapper::perception::planes {

/// Sums over the pixels of a run: of their residuals r from a plane [1/m], their depths z [m] and products of these; x
/// [px] counts from the first pixel of the run.
struct RunSums {
  double r = 0, xr = 0, rr = 0;
  double z = 0, xz = 0;
};

/// `values` are the inverse depths of the run's n pixels, all measured; seven values behind them are read but not used.
/// The plane is `start` + `slope` x.
RunSums sumRun(const float* values, int n, float start, float slope);

/// Sum of (z r)^2 over the same pixels; z r is a pixel's distance from the plane as a share of its depth.
double sumRelativeSquares(const float* values, int n, float start, float slope);

}  // namespace omnimapper::perception::planes

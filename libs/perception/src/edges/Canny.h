#pragma once

#include <omnimapper/perception/ColourImage.h>

#include "Hysteresis.h"

namespace omnimapper::perception::edges {

/// Canny's edges, kKept: Sobel's 3 x 3 operators on the grey picture (borders repeated), |gx| + |gy|, its maxima across
/// the edge to 45 degrees, those above `low` that are connected with one above `high`.
Candidates canny(const ColourImage& image, int low, int high);

}  // namespace omnimapper::perception::edges

#pragma once

#include <omnimapper/camera/ColourImage.h>

#include "Hysteresis.h"

namespace omnimapper::perception::edges {

/// Finds Canny's edges, whose pixels are kKept: the gradient is |gx| + |gy| of Sobel's 3 x 3 operators on the grey
/// picture (borders repeated). Its maxima across the edge, in directions of 45 degrees, are edges if they are above
/// `low` and connected with one above `high`.
Candidates canny(const camera::ColourImage& image, int low, int high);

}  // namespace omnimapper::perception::edges

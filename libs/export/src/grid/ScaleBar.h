#pragma once

#include "grid/GridPicture.h"

namespace omnimapper::exports {

/// A round length [m] (1, 2 or 5 times a power of ten), about a sixth of a picture that is `width` [m] wide.
double scaleBarLength(double width);

/// Draws a bar of that length, with its length beside it, into the lower left corner of a picture of `grid`.
void drawScaleBar(draw::Image& image, const GridPicture& grid);

}  // namespace omnimapper::exports

#pragma once

#include "grid/GridPicture.h"

namespace omnimapper::exports {

/// A round length [m] (1, 2 or 5 times a power of ten) of about a sixth of `width` [m], the width of the picture.
double scaleBarLength(double width);

/// Draws a bar of that length, labelled with the length, into the lower left corner of a picture of `grid`.
void drawScaleBar(draw::Image& image, const GridPicture& grid);

}  // namespace omnimapper::exports

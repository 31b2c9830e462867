#pragma once

#include <omnimapper/derived/GridPicture.h>

namespace omnimapper::derived {

/// A round length [m] (1, 2 or 5 times a power of ten) of about a sixth of `width` [m], the width of the picture.
double scaleBarLength(double width);

/// Draws a bar of that length, labelled with the length, into the lower left corner of a picture of `grid`.
void drawScaleBar(draw::Image& image, const GridPicture& grid);

}  // namespace omnimapper::derived

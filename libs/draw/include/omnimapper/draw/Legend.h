#pragma once

#include <omnimapper/draw/Image.h>

#include <string>
#include <vector>

namespace omnimapper::draw {

/// A colour of a picture and its meaning.
struct LegendRow {
  Rgb colour;
  std::string text;
};

/// Adds a legend below the picture, which becomes higher, in up to `columns` columns as far as there is room. Letters
/// are `scale` times 6 by 13 px. A picture that is too small for the legend is not changed.
void drawLegend(Image& picture, const std::vector<LegendRow>& rows, int columns = 1, int scale = 1);

/// Writes a text on a light background with its upper left corner at (left, top) [px], or as close to it as the picture
/// has room; a picture smaller than the text is not changed.
void drawLabel(Image& picture, int left, int top, const std::string& text);

}  // namespace omnimapper::draw

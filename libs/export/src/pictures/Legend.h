#pragma once

#include <omnimapper/draw/Image.h>

#include <string>
#include <vector>

namespace omnimapper::exports {

/// What a colour of a picture means.
struct LegendRow {
  draw::Rgb colour;
  std::string text;
};

/// Adds what the colours mean below the picture, which grows by that, in as many columns as are asked for and have
/// room. Letters are `scale` times 6 by 13 px. A picture that is too small for it stays as it is.
void drawLegend(draw::Image& picture, const std::vector<LegendRow>& rows, int columns = 1, int scale = 1);

/// Writes a word on a light ground, its upper left corner there [px], or as near as the picture has room for it; a
/// picture smaller than the word keeps what it shows.
void drawLabel(draw::Image& picture, int left, int top, const std::string& text);

}  // namespace omnimapper::exports

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

/// Draws what the colours mean into the upper left corner, on a light ground. A picture that is too small for it keeps
/// what it shows.
void drawLegend(draw::Image& picture, const std::vector<LegendRow>& rows);

/// Writes a word on a light ground, its upper left corner there [px], or as near as the picture has room for it; a
/// picture smaller than the word keeps what it shows.
void drawLabel(draw::Image& picture, int left, int top, const std::string& text);

}  // namespace omnimapper::exports

#pragma once

#include <string>
#include <vector>

#include "../output/Image.h"

namespace omnimapper::plugins {

/// What a colour of a picture means.
struct LegendRow {
  Rgb colour;
  std::string text;
};

/// Draws what the colours mean into the upper left corner, on a light ground. A picture that is too small for it keeps
/// what it shows.
void drawLegend(Image& picture, const std::vector<LegendRow>& rows);

/// Writes a word on a light ground, its upper left corner there [px], or as near as the picture has room for it; a
/// picture smaller than the word keeps what it shows.
void drawLabel(Image& picture, int left, int top, const std::string& text);

}  // namespace omnimapper::plugins

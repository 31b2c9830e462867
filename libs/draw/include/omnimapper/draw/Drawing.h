#pragma once

#include <omnimapper/draw/Image.h>

#include <vector>

namespace omnimapper::draw {

/// A place in a picture [pixels], right and down from its upper left corner; (0.5, 0.5) is the middle of a pixel.
struct PixelPoint {
  double x = 0, y = 0;
};

/// Colour, width and opacity of ink on a picture.
struct Pen {
  Rgb colour;
  double width = 1;    ///< [pixels]
  double opacity = 1;  ///< 0 to 1
};

/// Draws a path with smooth edges; what lies outside the picture is cut off. Where a path crosses itself, ink is
/// applied only once.
void drawPath(Image& image, const std::vector<PixelPoint>& path, const Pen& pen);
/// Fills the pixels whose middle lies in an odd number of closed contours; the pen's width is not used.
void fillAreas(Image& image, const std::vector<std::vector<PixelPoint>>& contours, const Pen& pen);
void drawLine(Image& image, PixelPoint from, PixelPoint to, const Pen& pen);
/// A disc of the pen's width around `centre`.
void drawDot(Image& image, PixelPoint centre, const Pen& pen);

}  // namespace omnimapper::draw

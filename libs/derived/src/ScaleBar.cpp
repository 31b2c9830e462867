#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/ScaleBar.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace omnimapper::derived {

namespace {

constexpr draw::Rgb kInk{24, 33, 47};

/// Strokes of a character in a box 4 wide and 6 high, y down. It has the digits of lengths that are 1, 2 or 5 times a
/// power of ten.
std::vector<std::vector<draw::PixelPoint>> strokesOf(char character) {
  switch (character) {
    case '0':
      return {{{0, 2}, {1, 0}, {3, 0}, {4, 2}, {4, 4}, {3, 6}, {1, 6}, {0, 4}, {0, 2}}};
    case '1':
      return {{{1, 1.3}, {2.5, 0}, {2.5, 6}}};
    case '2':
      return {{{0, 1.5}, {1, 0}, {3, 0}, {4, 1.3}, {4, 2.2}, {0, 6}, {4, 6}}};
    case '5':
      return {{{4, 0}, {0.4, 0}, {0, 2.8}, {1.2, 2.2}, {3, 2.2}, {4, 3.4}, {4, 4.8}, {3, 6}, {1, 6}, {0, 5}}};
    case '.':
      return {{{1.8, 5.8}, {2.2, 5.8}}};
    case 'm':
      return {{{0, 2.2}, {0, 6}}, {{0, 3}, {1, 2.2}, {2, 3}, {2, 6}}, {{2, 3}, {3, 2.2}, {4, 3}, {4, 6}}};
    default:
      return {};
  }
}

}  // namespace

double scaleBarLength(double width) {
  const double power = std::pow(10, std::floor(std::log10(width / 6))), mantissa = width / 6 / power;
  return power * (mantissa < 2 ? 1 : mantissa < 5 ? 2 : 5);
}

void drawScaleBar(draw::Image& image, const GridPicture& grid) {
  const double length = scaleBarLength(image.width * grid.metres_per_pixel);
  const double size = std::max(image.width, image.height) / 60.0, pen = std::max(1.5, size / 8);
  const double left = size, right = left + length / grid.metres_per_pixel, y = image.height - size;
  // A light background, so that the text can be read over walls, too.
  const double middle = y - 0.4 * size, end = right + 5.5 * size;
  drawLine(image, {left, middle}, {end, middle}, {{255, 255, 255}, 2 * size, 0.85});
  drawPath(image, {{left, y - 0.5 * size}, {left, y}, {right, y}, {right, y - 0.5 * size}}, {kInk, pen});
  const double unit = size / 6;
  double x = right + size;
  for (const char character : base::brief(length) + " m") {
    for (auto stroke : strokesOf(character)) {
      for (draw::PixelPoint& point : stroke) point = {x + point.x * unit, y - size + point.y * unit};
      drawPath(image, stroke, {kInk, pen});
    }
    x += (character == ' ' ? 3 : 6) * unit;
  }
}

}  // namespace omnimapper::derived

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::draw {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// Pixels of full colour, row by row from the top.
struct Image {
  Image(int width_pixels, int height_pixels, Rgb colour)
      : width(width_pixels), height(height_pixels), pixels(static_cast<std::size_t>(width) * height, colour) {}
  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }

  int width, height;
  std::vector<Rgb> pixels;
};

/// Pixels as indices into a palette of at most 256 colours, row by row from the top.
struct PaletteImage {
  int width = 0, height = 0;
  std::vector<Rgb> palette;
  std::vector<std::uint8_t> pixels;
};

/// Grey pixels of 16 bits, such as depths or object numbers, row by row from the top.
struct Grey16Image {
  int width = 0, height = 0;
  std::vector<std::uint16_t> pixels;
};

/// The bytes of a PNG file (ISO/IEC 15948). The same picture gives the same bytes.
std::string encodePng(const Image& image);
std::string encodePng(const PaletteImage& image);
/// Throws Error(internal) if the number of pixels is 0 or is not width * height.
std::string encodePng(const Grey16Image& image);

}  // namespace omnimapper::draw

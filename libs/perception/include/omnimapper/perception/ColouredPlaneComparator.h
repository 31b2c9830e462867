#pragma once

#include <omnimapper/perception/PlaneComparator.h>

#include <cstdint>

namespace omnimapper::perception {

/// Comparator: neighbours on one smooth surface and of one colour (thesis 3.4.5): sheets of paper on a table.
struct ColouredPlaneComparator {
  PlaneComparator plane;
  const std::uint8_t* rgb;         ///< three bytes for each pixel, of the same view as the depth
  float max_colour_distance = 30;  ///< Euclidean, in the 256 steps of a channel

  bool valid(int pixel) const { return plane.valid(pixel); }

  bool similar(int a, int b) const {
    const std::uint8_t *p = rgb + 3 * static_cast<std::ptrdiff_t>(a), *q = rgb + 3 * static_cast<std::ptrdiff_t>(b);
    const int red = p[0] - q[0], green = p[1] - q[1], blue = p[2] - q[2];
    return static_cast<float>(red * red + green * green + blue * blue) <= max_colour_distance * max_colour_distance &&
           plane.similar(a, b);
  }
};

extern template Components connectComponents(int, int, const ColouredPlaneComparator&);

}  // namespace omnimapper::perception

#pragma once

#include <omnimapper/obs/Rgb.h>

#include <cstdint>

namespace omnimapper::perception {

/// What a comparator of planes works on: the pixels of a depth image, row by row, each on one plane or on none. There
/// may be columns and rows of padding, which are on none.
struct PlanePixels {
  int width = 0, height = 0;
  const std::uint16_t* planes = nullptr;  ///< of each pixel the number of its plane, or 0
  const obs::Rgb* colours = nullptr;      ///< of each pixel on a plane; null for a comparison that needs none
};

}  // namespace omnimapper::perception

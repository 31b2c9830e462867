#pragma once

#include <omnimapper/obs/Rgb.h>

#include <cstdint>

namespace omnimapper::perception {

/// The input of a comparator of planes: the pixels of a depth image, row by row. Each pixel lies on one plane or on
/// none. There may be columns and rows of padding, whose pixels lie on no plane.
struct PlanePixels {
  int width = 0, height = 0;
  const std::uint16_t* planes = nullptr;  ///< for each pixel the number of its plane, or 0
  const obs::Rgb* colours = nullptr;  ///< colour of each pixel on a plane; null for a comparison that needs no colours
};

}  // namespace omnimapper::perception

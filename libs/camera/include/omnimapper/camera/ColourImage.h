#pragma once

#include <cstdint>

namespace omnimapper::camera {

/// A colour picture that somebody else owns: rows from the top, `stride` bytes apart, each pixel one byte (grey) or
/// three.
struct ColourImage {
  enum class Order { grey, rgb, bgr };
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;
  int stride = 0;  ///< [byte]
  Order order = Order::rgb;
};

}  // namespace omnimapper::camera

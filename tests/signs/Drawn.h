#pragma once

#include <omnimapper/signs/SignDetector.h>

#include <cstdint>
#include <vector>

namespace omnimapper::signs {

/// A grey picture in which tests draw rectangles.
struct Drawn {
  int width, height;
  std::vector<std::uint8_t> pixels;

  Drawn(int columns, int rows, std::uint8_t grey)
      : width(columns), height(rows), pixels(static_cast<std::size_t>(columns * rows), grey) {}
  /// Fills columns and rows from the first to the one before the last.
  void fill(int left, int top, int right, int bottom, std::uint8_t grey) {
    for (int row = top; row < bottom; ++row) {
      for (int column = left; column < right; ++column) pixels[static_cast<std::size_t>(row * width + column)] = grey;
    }
  }
  camera::ColourImage view() const { return {pixels.data(), width, height, width, camera::ColourImage::Order::grey}; }
};

inline Corners rectangle(float left, float top, float right, float bottom) {
  return {Eigen::Vector2f(left, top), Eigen::Vector2f(right, top), Eigen::Vector2f(right, bottom),
          Eigen::Vector2f(left, bottom)};
}

}  // namespace omnimapper::signs

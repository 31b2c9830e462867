#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace omnimapper::sim {

/// A picture on a surface: row-major RGB, row 0 at the top.
struct Texture {
  int width = 0, height = 0;      ///< [pixel]
  std::vector<std::uint8_t> rgb;  ///< width * height * 3

  /// Colour in [0, 1]^3 at (u, v), bilinear; u to the right and v up run over the picture in [0, 1] and repeat beyond.
  Eigen::Vector3f at(float u, float v) const;
};

}  // namespace omnimapper::sim

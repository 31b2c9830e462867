#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace omnimapper::sim {

/// A picture on a surface: row-major RGB, row 0 at the top.
struct Texture {
  int width = 0, height = 0;      ///< [pixel]
  std::vector<std::uint8_t> rgb;  ///< width * height * 3

  /// Colour in [0, 1]^3 at (u, v), by bilinear interpolation. The picture spans [0, 1] in u, to the right, and in v,
  /// upwards; beyond that it repeats.
  Eigen::Vector3f at(float u, float v) const;
};

}  // namespace omnimapper::sim

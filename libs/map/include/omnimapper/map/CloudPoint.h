#pragma once

#include <mrpt/math/TPoint3D.h>

#include <cmath>
#include <cstdint>

namespace omnimapper::map {

/// A coloured point of a depth image in the base frame of its key frame: whole millimetres, coordinates within 32 m.
struct CloudPoint {
  std::int16_t x = 0, y = 0, z = 0;  ///< [mm]
  std::uint8_t red = 0, green = 0, blue = 0;

  static constexpr float kReach = 32;  ///< [m] largest absolute value of a coordinate
  static std::int16_t millimetres(float metres) { return static_cast<std::int16_t>(std::lround(1000 * metres)); }
  mrpt::math::TPoint3D inBase() const { return {0.001 * x, 0.001 * y, 0.001 * z}; }  ///< [m]
};

}  // namespace omnimapper::map

#pragma once

#include <mrpt/math/TPoint3D.h>

#include <cmath>
#include <cstdint>

namespace omnimapper::mapper {

/// The number of the cube of that side [m] in which a point lies; unique within 2^20 sides of the origin.
inline std::uint64_t cubeOf(const mrpt::math::TPoint3D& point, double side) {
  const auto cell = [&](double coordinate) {
    return static_cast<std::uint64_t>(std::llround(std::floor(coordinate / side)) + (1 << 20)) & 0x1FFFFF;
  };
  return cell(point.x) << 42 | cell(point.y) << 21 | cell(point.z);
}

}  // namespace omnimapper::mapper

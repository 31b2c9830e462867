#pragma once

#include <cmath>

namespace omnimapper::sim {

/// The transfer curve of IEC 61966-2-1, in both directions; values in [0, 1].
inline double linearFromSrgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}
inline double srgbFromLinear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace omnimapper::sim

#pragma once

#include <cmath>

namespace omnimapper::geometry {

constexpr double kPi = 3.14159265358979323846;

/// The angle [rad] in (-pi, pi] that differs from `angle` by a multiple of 2 pi.
inline double wrapToPi(double angle) {
  if (angle > -kPi && angle <= kPi) return angle;
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace omnimapper::geometry

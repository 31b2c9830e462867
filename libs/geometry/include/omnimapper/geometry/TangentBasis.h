#pragma once

#include <Eigen/Core>
#include <cmath>

namespace omnimapper::geometry {

/// Two unit columns that make a right-handed frame (first, second, n) with the unit vector `n`: the directions that a
/// 2-vector in the tangent of `n` counts along. A function of `n` alone, continuous except where n.z changes its sign.
/// Source: Duff et al., Building an orthonormal basis, revisited, JCGT 6(1), 2017.
inline Eigen::Matrix<double, 3, 2> tangentBasis(const Eigen::Vector3d& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) << 1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x();
  basis.col(1) << b, sign + n.y() * n.y() * a, -n.y();
  return basis;
}

}  // namespace omnimapper::geometry

#pragma once

#include <omnimapper/geometry/Se2.h>

#include <Eigen/Geometry>

namespace omnimapper::graph {

/// The residual of BetweenSe2, whitened, written again for Ceres' automatic derivatives on x y yaw: a peer to test
/// against.
struct GridEdge {
  template <class T>
  bool operator()(const T* a, const T* b, T* r) const {
    const T c = cos(a[2]), s = sin(a[2]), dx = b[0] - a[0], dy = b[1] - a[1];
    const Eigen::Matrix<T, 2, 1> apart(c * dx + s * dy - measured.x, c * dy - s * dx - measured.y);
    const Eigen::Rotation2D<T> back(T(-measured.yaw));
    const Eigen::Matrix<T, 2, 1> turned = back * apart;
    Eigen::Matrix<T, 3, 1> error(turned.x(), turned.y(), b[2] - a[2] - measured.yaw);
    const T turns = floor((error[2] + geometry::kPi) / (2 * geometry::kPi));
    error[2] -= turns * (2 * geometry::kPi);
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{r} = whitening.cast<T>() * error;
    return true;
  }
  geometry::Se2 measured;
  Eigen::Matrix3d whitening;
};

}  // namespace omnimapper::graph

#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/geometry/SymmetricEigen.h>

namespace omnimapper::plugins {

/// Projector onto the unconstrained directions: those whose variance is more than half of `variance_of_open`.
inline geometry::Matrix6d openDirections(const geometry::Matrix6d& covariance, double variance_of_open) {
  const auto axes = geometry::eigenOf<6>(covariance);
  const geometry::Vector6d is_open =
      axes.values.unaryExpr([&](double value) { return value > 0.5 * variance_of_open ? 1.0 : 0.0; });
  return axes.vectors * is_open.asDiagonal() * axes.vectors.transpose();
}

}  // namespace omnimapper::plugins

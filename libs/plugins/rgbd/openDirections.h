#pragma once

#include <omnimapper/geometry/Se3.h>

#include <Eigen/Eigenvalues>

namespace omnimapper::plugins {

/// Projector onto the unconstrained directions: those whose variance is more than half of `variance_of_open`.
inline geometry::Matrix6d openDirections(const geometry::Matrix6d& covariance, double variance_of_open) {
  const Eigen::SelfAdjointEigenSolver<geometry::Matrix6d> axes(covariance);
  const geometry::Vector6d is_open =
      axes.eigenvalues().unaryExpr([&](double value) { return value > 0.5 * variance_of_open ? 1.0 : 0.0; });
  return axes.eigenvectors() * is_open.asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace omnimapper::plugins

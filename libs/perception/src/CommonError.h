#pragma once

#include <Eigen/LU>
#include <cmath>

namespace omnimapper::perception {

/// How far rays may be apart and still share what bends a sensor's image: a quarter of a Kinect's width of 1.2, since
/// the pattern of its error changes between the middle and the rim. Source: Teichman, Miller, Thrun: Unsupervised
/// intrinsic calibration of depth sensors via SLAM, RSS 2013, figures of the distortion.
constexpr double kBendReach = 0.3;

/// What least squares over part of an image make of an error that changes slowly over it and so does not average out:
/// a random field of variance 1, correlated as exp(-|a - b|^2 / (2 kBendReach^2)) between rays a and b.
struct CommonError {
  double offset;          ///< variance of its value in the middle of the part
  Eigen::Matrix2d slope;  ///< covariance of its slope, which is independent of that
};

/// For rays with that covariance about their middle. Exact if they are spread as a normal distribution: with x and y
/// two such, the slope is spread^-1 E[x e(x)], whose covariance has E[x y^T k(x - y)] in its middle.
inline CommonError commonError(const Eigen::Matrix2d& spread) {
  constexpr double kSquared = kBendReach * kBendReach;
  const Eigen::Matrix2d left = (Eigen::Matrix2d::Identity() + 2 / kSquared * spread).inverse();
  const double offset = std::sqrt(left.determinant());
  return {offset, offset / kSquared * left};
}

}  // namespace omnimapper::perception

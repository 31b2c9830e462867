#pragma once

#include <Eigen/LU>
#include <cmath>

namespace omnimapper::perception {

/// Correlation length of a sensor's systematic distortion, between rays (x/z, y/z): a quarter of a Kinect's image,
/// which is 1.2 wide, since the pattern of its error changes between the middle and the rim. Source: Teichman, Miller,
/// Thrun: Unsupervised intrinsic calibration of depth sensors via SLAM, RSS 2013, figures of the distortion.
constexpr double kDistortionReach = 0.3;

/// Effect on a least squares fit over part of an image of an error that changes slowly over the image and so does not
/// average out: a random field of variance 1, correlated as exp(-|a - b|^2 / (2 kDistortionReach^2)) between rays a, b.
struct CommonError {
  double offset;          ///< variance of the fitted value in the middle of the part
  Eigen::Matrix2d slope;  ///< covariance of the fitted slope, which is independent of it
};

/// `spread` is the covariance of the rays about their middle. Exact if the rays are normally distributed: the slope is
/// spread^-1 E[x e(x)] for a ray x with the error e(x), so its covariance is spread^-1 E[x y^T k(x - y)] spread^-1 for
/// two independent rays x and y and the correlation k.
inline CommonError commonError(const Eigen::Matrix2d& spread) {
  constexpr double kSquared = kDistortionReach * kDistortionReach;
  const Eigen::Matrix2d left = (Eigen::Matrix2d::Identity() + 2 / kSquared * spread).inverse();
  const double offset = std::sqrt(left.determinant());
  return {offset, offset / kSquared * left};
}

}  // namespace omnimapper::perception

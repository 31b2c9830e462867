#include "PlanarMotion.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose2D.h>

#include <array>
#include <cmath>

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

TPose2D planar(const mrpt::poses::CPose3D& pose) {
  // CPose3D::yaw() computes its result lazily inside the pose, which is unsafe because threads share poses.
  const auto& rotation = pose.getRotationMatrix();
  return {pose.x(), pose.y(), std::atan2(rotation(1, 0), rotation(0, 0))};
}

PoseDistance distanceBetween(const TPose2D& a, const TPose2D& b) {
  return {std::hypot(a.x - b.x, a.y - b.y), std::abs(mrpt::math::wrapToPi(a.phi - b.phi))};
}

double sizeOf(const TPose2D& motion) {
  constexpr double kLever = 3;  // [m]
  return std::hypot(motion.x, motion.y) + kLever * std::abs(mrpt::math::wrapToPi(motion.phi));
}

mapper::RelativeMotion planarMotion(const TPose2D& begin_from_end, const Eigen::Matrix3d& covariance) {
  mapper::RelativeMotion motion;
  motion.begin_from_end = mrpt::poses::CPose3D(mrpt::poses::CPose2D(begin_from_end));
  // A scan does not measure height and tilt: their standard deviations are 1 m and 0.5 rad, for spatial maps.
  motion.covariance = Eigen::Matrix<double, 6, 6>::Zero();
  motion.covariance.diagonal() << 0, 0, 1.0, 0.25, 0.25, 0;
  const std::array<int, 3> index{0, 1, 5};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      motion.covariance(index[row], index[column]) = covariance(row, column);
    }
  }
  return motion;
}

}  // namespace omnimapper::plugins

#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>

namespace omnimapper::motion {

/// Random errors of an odometry, learned where walls determined the motion: over spans of about a metre or a radian, in
/// which the errors of the odometry add up while those of the matches do not, and from scan to scan, in which errors of
/// stamps show that do not add up. The larger of the two counts.
class OdometryErrors {
 public:
  /// Adds a motion to the span: as the odometry measured it, corrected by its calibration, and as it actually was, with
  /// the variances of its position and heading [m2] [rad2].
  void add(const mrpt::math::TPose2D& measured, const mrpt::math::TPose2D& actual, double position_variance,
           double yaw_variance);
  /// Forgets the span that was begun, because the next motion was not determined by walls.
  void interrupt();
  /// Covariance of a measured motion: x y yaw at its end [m] [rad].
  Eigen::Matrix3d covarianceOf(const mrpt::math::TPose2D& measured) const;

 private:
  mrpt::math::TPose2D measured_, actual_;    // since the span began
  double travel_ = 0, turn_ = 0;             // [m] [rad] the same
  double position_rate_ = 0.03 * 0.03;       // [m2/m]
  double yaw_rate_ = 0.02 * 0.02;            // [rad2/m] and [rad2/rad]
  double scan_position_ = 0, scan_yaw_ = 0;  // [m2] [rad2] from one scan to the next
};

}  // namespace omnimapper::motion

#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>

namespace omnimapper::motion {

/// Systematic errors of wheel odometry, learned from motions that are known better. The odometry measures the distance
/// travelled too long or too short, its heading drifts with the distance travelled (wheels of different size), and it
/// measures turns too large or too small (Borenstein and Feng, "Measurement and correction of systematic odometry
/// errors in mobile robots", 1996). What was learned fades over about 25 m of travel, because loads and floors change;
/// in the first metres little is corrected.
class OdometryCalibration {
 public:
  /// Learns from a motion as the odometry measured it and as it actually was. Pairs that differ too much, by slip or by
  /// a wrong match, are ignored.
  void learn(const mrpt::math::TPose2D& measured, const mrpt::math::TPose2D& actual);
  /// The measured motion, corrected by what was learned.
  mrpt::math::TPose2D applied(const mrpt::math::TPose2D& measured) const;

 private:
  /// Errors of the heading: for each metre travelled [rad/m], and as a share of a turn.
  Eigen::Vector2d turnErrors() const;
  /// Error of the distance travelled, as a share of it.
  double travelError() const;

  double travel_information_ = 0, travel_sum_ = 0;  // least squares, weighted by each motion's inverse variance
  Eigen::Matrix2d turn_information_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d turn_sum_ = Eigen::Vector2d::Zero();
};

}  // namespace omnimapper::motion

#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>

namespace omnimapper::matching {

/// What wheel odometry errs by in the same way again and again, learned from motion that is known better: it measures
/// the way too long or too short, turns with the way it drives (wheels of different size), and turns too far or too
/// little (Borenstein and Feng, "Measurement and correction of systematic odometry errors in mobile robots", 1996).
/// What was learned fades after some ten metres, as loads and floors change; in the first metres little is
/// corrected.
class OdometryCalibration {
 public:
  /// A motion as the odometry told it, and as it was. Motions that are far from one another, by slip or by a wrong
  /// match, teach nothing.
  void learn(const mrpt::math::TPose2D& told, const mrpt::math::TPose2D& was);
  /// The motion without what was learned.
  mrpt::math::TPose2D applied(const mrpt::math::TPose2D& told) const;

 private:
  /// Of the heading [rad]: after 1 m of way [rad/m], after 1 rad of turn.
  Eigen::Vector2d turnErrors() const;
  /// Of the way, as a share.
  double travelError() const;

  double travel_information_ = 0, travel_sum_ = 0;  // least squares, weighted by the variance of each motion
  Eigen::Matrix2d turn_information_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d turn_sum_ = Eigen::Vector2d::Zero();
};

}  // namespace omnimapper::matching

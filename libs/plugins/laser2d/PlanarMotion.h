#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/plugin/RelativeMotion.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// The part of a pose that lies in the plane: x, y and yaw.
mrpt::math::TPose2D planar(const mrpt::poses::CPose3D& pose);

/// Distance between two planar poses, [m] and [rad].
struct PoseDistance {
  double metres, radians;
  bool within(double most_metres, double most_radians) const {
    return metres <= most_metres && radians <= most_radians;
  }
  /// Distance and angle combined in one number [m], by which the views of a laser at two poses are compared: views with
  /// different headings share little of a place.
  double ofViews() const { return metres + 2 * radians; }
};
PoseDistance distanceBetween(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b);

/// A planar motion with its covariance (x, y, yaw). For spatial maps height and tilt get wide variances.
mapper::RelativeMotion planarMotion(const mrpt::math::TPose2D& begin_from_end, const Eigen::Matrix3d& covariance);

/// A share of a motion, as if position and heading changed evenly.
inline mrpt::math::TPose2D scaled(const mrpt::math::TPose2D& motion, double factor) {
  return {factor * motion.x, factor * motion.y, factor * motion.phi};
}
/// How far a motion displaces a point some metres away from the base [m].
double sizeOf(const mrpt::math::TPose2D& motion);

}  // namespace omnimapper::plugins

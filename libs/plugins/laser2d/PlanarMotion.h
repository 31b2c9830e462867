#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/plugin/RelativeMotion.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// What of a pose is in the plane.
mrpt::math::TPose2D planar(const mrpt::poses::CPose3D& pose);

/// How far two poses are apart, [m] and [rad].
struct PoseDistance {
  double metres, radians;
  bool within(double most_metres, double most_radians) const {
    return metres <= most_metres && radians <= most_radians;
  }
  /// As a laser sees it [m]: one that looks another way has seen little of the same.
  double ofViews() const { return metres + 2 * radians; }
};
PoseDistance distanceBetween(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b);

/// A motion in the plane, covariance of x y yaw. Height and tilt stay open, as far as a spatial map asks for them.
mapper::RelativeMotion planarMotion(const mrpt::math::TPose2D& begin_from_end, const Eigen::Matrix3d& covariance);

}  // namespace omnimapper::plugins

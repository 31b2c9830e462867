#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/mapper/RelativeMotion.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// What of a pose is in the plane.
mrpt::math::TPose2D planar(const mrpt::poses::CPose3D& pose);

/// A motion in the plane, covariance of x y yaw. Height and tilt stay open, as far as a spatial map asks for them.
mapper::RelativeMotion planarMotion(const mrpt::math::TPose2D& begin_from_end, const Eigen::Matrix3d& covariance);

}  // namespace omnimapper::plugins

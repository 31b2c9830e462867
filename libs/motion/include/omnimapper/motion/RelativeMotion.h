#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Core>

namespace omnimapper::motion {

/// Motion of the base over a span of time.
struct RelativeMotion {
  mrpt::poses::CPose3D begin_from_end;     ///< pose of the base at the span's end, in the base at its beginning
  Eigen::Matrix<double, 6, 6> covariance;  ///< tangent at the end: x y z [m], rotation vector [rad]
};

}  // namespace omnimapper::motion

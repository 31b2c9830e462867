#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>

#include <Eigen/Core>
#include <optional>

namespace omnimapper::mapper {

/// The pose of the base that a run which localizes in a map estimated at a key frame, without any later data.
struct LocalizationEstimate {
  base::KeyFrameId key_frame;
  base::Stamp stamp;
  mrpt::poses::CPose3D map_from_base;
  /// Covariance in the tangent at the pose: x y z [m], rotation vector [rad]; the map itself counts as exact. None
  /// while some direction of a variable is undetermined.
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  /// A measurement had tied the session to the map, and what was seen lately confirms its place (ConfirmsSession).
  bool aligned = false;

  /// Covariance of the position along the map's axes [m^2]; none if `covariance` is none.
  std::optional<Eigen::Matrix3d> positionCovariance() const;
  /// Whether the session is aligned and its position is certain: the standard deviation in the least certain direction
  /// on the floor is at most kLocatedSigma [m]. The height is left out because a planar laser does not measure the
  /// height.
  bool located() const;
  static constexpr double kLocatedSigma = 0.5;
};

}  // namespace omnimapper::mapper

#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>

#include <Eigen/Core>
#include <optional>

namespace omnimapper::mapper {

/// Where a run that localizes in a map knew the base to be when a key frame came, from nothing that came later.
struct LocalizationEstimate {
  base::KeyFrameId key_frame;
  base::Stamp stamp;
  mrpt::poses::CPose3D map_from_base;
  /// In the tangent at the pose: x y z [m], rotation vector [rad]; the map itself counts as exact. None while a
  /// direction is open.
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  bool joined = false;  ///< something measured had tied the session to the map

  /// Of the position, along the map's axes [m^2]; none as above.
  std::optional<Eigen::Matrix3d> positionCovariance() const;
  /// Joined, and the position on the floor known to within kLocatedSigma [m] (standard deviation in the worst
  /// direction): a laser in the plane never tells the height.
  bool located() const;
  static constexpr double kLocatedSigma = 0.5;
};

}  // namespace omnimapper::mapper

#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "SignBearingFactor.h"

namespace omnimapper::plugins {

/// The direction to a known sign of the map, measured in a session whose place in the map is unknown.
struct KnownSignBearing {
  base::LandmarkId sign;
  bool is_numbered;                 ///< the sign has a number that is probably on this sign only
  Eigen::Vector3d in_map;           ///< [m] position of the sign in the map
  Eigen::Vector3d normal;           ///< unit vector, towards the side from which the sign is read
  geometry::Se3 session_from_base;  ///< by odometry
  MeasuredDirection seen;
  double sigma;  ///< [rad] standard deviation, including that of the sign's position
};

/// map_from_base of a level base that sees the sign from `distance` [m] straight in front of the sign.
geometry::Se3 baseBefore(const KnownSignBearing& measurement, double distance);

/// The pose of a session in the map.
struct SessionFit {
  geometry::Se3 map_from_session;  ///< a rotation about the vertical and a translation on the floor
  double position_sigma = 0;       ///< [m] of the newest base, along the direction that is known worst
  double angle_sigma = 0;          ///< [rad]
  std::size_t fitting = 0;         ///< number of measurements that fit within three standard deviations
};

/// Resection: the pose of a session from which known signs are seen in these directions. `measurements`: the newest
/// last. There is a result only if all of these conditions hold: At least four measurements of at least two signs fit,
/// and one of the signs is numbered. At least two thirds of all measurements fit. The base moved at least 0.5 m between
/// the measurements that fit. The sigma of the position is at most 0.35 m. No other place fits nearly as many
/// measurements. Derivation: doc/derivations/bearing.md.
std::optional<SessionFit> resection(const std::vector<KnownSignBearing>& measurements);

}  // namespace omnimapper::plugins

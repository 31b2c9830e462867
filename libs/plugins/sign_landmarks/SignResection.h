#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "SignBearingFactor.h"

namespace omnimapper::plugins {

/// A direction in which a sign of the map is seen from a session that is lost.
struct SeenKnownSign {
  base::LandmarkId sign;
  bool is_numbered;                 ///< it has a number that is probably on no other sign
  Eigen::Vector3d in_map;           ///< [m] where the map has it
  Eigen::Vector3d normal;           ///< unit, to the side from which it is read
  geometry::Se3 session_from_base;  ///< by odometry
  SeenDirection seen;
  double sigma;  ///< [rad] standard deviation, with that of the sign's position
};

/// The base in the map, level, if the sign is seen from `distance` [m] straight before it.
geometry::Se3 baseBefore(const SeenKnownSign& sighting, double distance);

/// Where a session lies in the map.
struct SessionFit {
  geometry::Se3 map_from_session;  ///< a turn about the vertical and a shift on the floor
  double position_sigma = 0;       ///< [m] of the newest base, along the direction that is known worst
  double angle_sigma = 0;          ///< [rad]
  std::size_t fitting = 0;         ///< measurements within three standard deviations
};

/// Resection: the pose from which the signs are seen in these directions, the newest of them last. None unless at least
/// four measurements of two signs fit, one of which is numbered, two in three of all measurements fit, the base went
/// 0.5 m between them, the position comes out to 0.35 m, and nowhere else nearly as many fit. Derivation:
/// doc/derivations/bearing.md.
std::optional<SessionFit> resection(const std::vector<SeenKnownSign>& sightings);

}  // namespace omnimapper::plugins

#pragma once

#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "SignBearingFactor.h"

namespace omnimapper::plugins {

/// A direction in which a sign of the map is seen from a session that is lost.
struct SeenKnownSign {
  std::size_t sign;                 ///< number of the sign, whichever way they are counted
  bool is_numbered;                 ///< its text is hardly on another door
  Eigen::Vector3d in_map;           ///< [m]
  Eigen::Vector3d normal;           ///< unit: to where the sign is read from
  geometry::Se3 session_from_base;  ///< by odometry
  SeenDirection seen;
  double sigma;  ///< [rad]
};

/// The base in the map, level, if the sign is seen from `distance` [m] straight before it.
geometry::Se3 baseBefore(const SeenKnownSign& sighting, double distance);

/// Where a session lies in the map.
struct SessionFit {
  geometry::Se3 map_from_session;  ///< a turn about the vertical and a shift on the floor
  double position_sigma = 0;       ///< [m] of the newest base, along the direction that is known worst
  double angle_sigma = 0;          ///< [rad]
  std::size_t fitting = 0;         ///< sightings within three standard deviations
};

/// Resection: the place and turn from which the signs are seen in these directions, the newest last. None unless at
/// least four sightings of two signs fit, of which one is numbered, two in three of all sightings fit, the position
/// comes out to 0.7 m, and no other place fits as many.
std::optional<SessionFit> resection(const std::vector<SeenKnownSign>& sightings);

}  // namespace omnimapper::plugins

#pragma once

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Stamp.h>

#include <optional>
#include <string_view>

namespace omnimapper::drivers {

/// Why a line of odometry was rejected.
enum class LineFault {
  malformed,   ///< a word that is not a number, or a number of words other than 4 and 7
  not_finite,  ///< "nan" or "inf"
  too_large,   ///< x or y beyond a million metres, yaw beyond a thousand turns, or more than 100 m/s or rad/s
};

/// One line that was read.
struct OdometryLine {
  std::optional<base::Stamp> stamp;  ///< none for "-", which stands for the time of arrival
  /// odom_from_base [m, rad], cumulative; velocityLocal in the base [m/s, rad/s], if the line has velocities. Stamp and
  /// label of the observation are not set.
  mrpt::obs::CObservationOdometry odometry;
  std::optional<LineFault> fault;  ///< if set, the other members are invalid
};

/// Reads `stamp x y yaw` or `stamp x y yaw vx vy omega`. The stamp is in seconds since 1970, UTC, with at most 9
/// decimals, or "-". `x y yaw` are odom_from_base in m and rad; `vx vy omega` are the velocity of the base in its own
/// frame in m/s and rad/s. Words are separated by blanks or tabs. `line` has no line feed. Never throws.
OdometryLine parseOdometryLine(std::string_view line);

}  // namespace omnimapper::drivers

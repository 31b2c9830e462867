#pragma once

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Stamp.h>

#include <optional>
#include <string_view>

namespace omnimapper::drivers {

/// Why a line of odometry was rejected.
enum class LineFault {
  malformed,   ///< a word that is no number, or neither 4 nor 7 words
  not_finite,  ///< "nan" or "inf"
  too_large,   ///< beyond a million metres from the start, a thousand turns, 100 m/s or 100 rad/s
};

/// One line that was read.
struct OdometryLine {
  std::optional<base::Stamp> stamp;  ///< none: "-", which means the time of arrival
  /// odom_from_base [m, rad], cumulative; velocityLocal in the base [m/s, rad/s] if the line has it. Its stamp
  /// and label are not set.
  mrpt::obs::CObservationOdometry odometry;
  std::optional<LineFault> fault;  ///< if set, the other members are invalid
};

/// Reads `stamp x y yaw` or `stamp x y yaw vx vy omega`: seconds since 1970, UTC, with at most 9 decimals, or "-";
/// odom_from_base in m and rad; the velocity of the base in its own frame in m/s and rad/s. Words are separated by
/// blanks or tabs. `line` has no line feed. Never throws.
OdometryLine parseOdometryLine(std::string_view line);

}  // namespace omnimapper::drivers

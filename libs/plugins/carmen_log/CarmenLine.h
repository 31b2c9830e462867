#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/base/Stamp.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace omnimapper::source {

/// Beams of a laser in its own frame: x ahead, angles counter-clockwise.
struct CarmenBeams {
  double first_angle = 0;  ///< [rad]
  double step = 0;         ///< [rad]
  double max_range = 0;    ///< [m] readings from here on are no echo
  double sigma = 0.01;     ///< [m] of a reading
};

struct CarmenParameter {
  std::string name, value;
};

struct CarmenOdometryLine {
  base::Stamp stamp;
  mrpt::math::TPose2D pose;  ///< odom_from_base
  double forward_speed = 0;  ///< [m/s]
  double turn_rate = 0;      ///< [rad/s]
};

/// A line with a scan and the odometry.
struct CarmenScanLine {
  std::string name;  ///< FLASER, ROBOTLASER1, ...
  base::Stamp stamp;
  std::vector<float> ranges;         ///< [m]
  mrpt::math::TPose2D laser_pose;    ///< odom_from_laser
  mrpt::math::TPose2D robot_pose;    ///< odom_from_base
  std::optional<CarmenBeams> beams;  ///< only if the line itself states them
};

/// A line that is not used; `name` is its first word, "" for an empty one or a comment.
struct CarmenOtherLine {
  std::string name;
};

using CarmenLine = std::variant<CarmenOtherLine, CarmenParameter, CarmenOdometryLine, CarmenScanLine>;

/// What is wrong with a line, as a clause whose subject is the line: "ends too early".
class BadCarmenLine : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws BadCarmenLine.
CarmenLine parseCarmenLine(std::string_view line);

/// Whether a line's first word is the name of a CARMEN message.
bool isCarmenWord(std::string_view word);

}  // namespace omnimapper::source

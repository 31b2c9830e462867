#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>

namespace omnimapper::map {

/// Which way is up in a map, and by what that is known. The map is not turned by it.
struct Level {
  enum class Source : std::uint8_t {
    unknown = 0,  ///< nobody can tell
    base = 1,     ///< a robot on wheels stands level
    planes = 2,   ///< most of the surfaces that were seen are level or upright
    imu = 3,      ///< an accelerometer measured gravity
  };
  Source source = Source::unknown;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit, in the map; where it is unknown the map's z
  /// Of the rotation vector in the map that takes the true up to `up` [rad^2]; nothing about `up` itself.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::string reason;  ///< half a sentence: "gravity in 41 spans of 'imu', 9.81 m/s^2"

  bool isKnown() const { return source != Source::unknown; }
  /// About the axis that is known least [rad].
  double standardDeviation() const;
  /// The least rotation that takes `up` to z: surfaces are judged and drawn from above in that frame.
  Eigen::Quaterniond levelFromMap() const;
};

/// "imu", "planes", "base" or "unknown".
std::string toString(Level::Source source);
/// "up is (0.00, -1.00, 0.02) of the map +- 0.3 deg, by planes: 12 of 14 m^2 are level or upright".
std::string sentenceOf(const Level& level);

}  // namespace omnimapper::map

#pragma once

#include <omnimapper/map/MapSection.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>

namespace omnimapper::map {

/// Which way is up in a map, and how that was found. The map itself is not rotated to be level. The layer "level" of a
/// map; a map whose run has not ended, or whose file is old, has none, and its z then counts as up.
struct Level {
  static constexpr char kLayer[] = "level";
  static constexpr std::uint32_t kLayerVersion = 1;

  enum class Source : std::uint8_t {
    unknown = 0,  ///< no source could determine it
    base = 1,     ///< a robot on wheels stands level
    planes = 2,   ///< most of the surfaces that were seen are level or upright
    imu = 3,      ///< an accelerometer measured gravity
  };
  Source source = Source::unknown;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit, in the map; the map's z if `source` is unknown
  /// Covariance [rad^2] of the error of `up`, as a rotation vector in the map that turns the true up direction into
  /// `up`; zero about `up` itself.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::string reason;  ///< half a sentence: "gravity in 41 spans of 'imu', 9.81 m/s^2"

  bool isKnown() const { return source != Source::unknown; }
  /// Standard deviation about the least certain axis [rad].
  double standardDeviation() const;
  /// The smallest rotation that turns `up` into z. Surfaces are judged, and drawn from above, in the rotated frame.
  Eigen::Quaterniond levelFromMap() const;

  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is another one, of a later version or damaged, if a number is not
  /// finite, or if up is not a unit vector.
  static Level fromSection(const MapSection& section);
};

/// "imu", "planes", "base" or "unknown".
std::string toString(Level::Source source);
/// "up is (0.00, -1.00, 0.02) of the map +- 0.3 deg, by planes: 12 of 14 m^2 are level or upright".
std::string sentenceOf(const Level& level);

}  // namespace omnimapper::map

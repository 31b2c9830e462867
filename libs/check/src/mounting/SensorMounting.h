#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/check/LogFacts.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::check {

/// One number of how a sensor is mounted, and what the log says of it.
struct Quantity {
  enum class State {
    as_declared,     ///< measured, and the declared value is as good
    corrected,       ///< measured, and the declared value is wrong
    not_determined,  ///< `reason` says why
    two_causes       ///< `reason` names both
  };
  std::string sensor;  ///< label
  std::string name;    ///< "yaw"
  State state = State::not_determined;
  std::string reason;      ///< by what it was measured, or why it was not: a part of a sentence
  std::string unit = "";   ///< "deg"; empty for a quantity without a unit
  int decimals = 2;        ///< with which it is written
  double declared = 0;     ///< in `unit`, as value and sigma
  Measured measured = {};  ///< for measured quantities
  std::string words = "";  ///< instead of the numbers, for a quantity that is none: "upside down"

  std::pair<std::string, std::string> key() const { return {sensor, name}; }
  std::string declaredText() const;  ///< "0.00 deg"
  std::string sigmaText() const;     ///< "+- 0.05 deg"; empty if there is no standard deviation
  std::string measuredText() const;  ///< "0.12 +- 0.05 deg", or `words`
};

/// What the mapper has to know of a sensor; keys that are not set stay as they are declared.
struct SensorKeys {
  std::optional<mrpt::poses::CPose3D> pose;  ///< base_from_sensor
  std::optional<double> clock_offset;        ///< [s] to add to the stamps
  std::optional<double> aperture;            ///< [rad]
};

/// What the section [calibration] has to hold for a depth camera.
struct CalibrationKeys {
  std::optional<double> depth_scale, fx, fy;  ///< [-] [px] [px]
  std::optional<bool> mirrored, depth_is_range;
  bool isEmpty() const { return !depth_scale && !fx && !fy && !mirrored && !depth_is_range; }
};

/// A contradiction that two causes explain. Nothing in the log tells which of them it is.
struct TwoCauses {
  std::string text;        ///< both causes, and what tells them apart
  std::string if_so;       ///< the cause for which the keys below are right: a part of a sentence
  std::string sensor;      ///< label
  SensorKeys keys;         ///< for a cause in the pose
  CalibrationKeys camera;  ///< for a cause in the images
};

/// How the sensors of a log are mounted, by its facts.
struct SensorMounting {
  std::vector<Quantity> quantities;
  std::map<std::string, SensorKeys> sensors;       ///< by label
  std::map<std::string, CalibrationKeys> cameras;  ///< by label
  std::optional<double> sweep;                     ///< [s] of the laser that laser odometry uses
  std::vector<TwoCauses> two_causes;

  bool isAnythingCorrected() const;
};

using QuantityKeys = std::set<std::pair<std::string, std::string>>;

/// Concludes from the facts of a log how its sensors are mounted. All poses and values are what the mapper must be
/// told, not the difference from what is declared. Quantities of `corrected` are replaced by what was measured even if
/// this differs little from what is declared: an earlier round corrected them.
SensorMounting sensorMounting(const LogFacts& facts, const QuantityKeys& corrected);

/// Parts of sensorMounting(): each adds what it measures to `mounting`. addCameras() uses what addLasers() added.
void addLasers(const LogFacts& facts, const QuantityKeys& corrected, SensorMounting& mounting);
void addCameras(const LogFacts& facts, const QuantityKeys& corrected, SensorMounting& mounting);
void addClocks(const LogFacts& facts, const QuantityKeys& corrected, SensorMounting& mounting);

}  // namespace omnimapper::check

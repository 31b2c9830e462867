#pragma once

#include <omnimapper/check/LogFacts.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::check {

enum class Weight {
  note,     ///< worth knowing
  warning,  ///< the map may suffer
  problem,  ///< without a remedy the map is likely wrong or empty
};

/// A finding: one note, warning or problem about a log, as a sentence with place and remedy.
struct Finding {
  Weight weight;
  std::string text;
  /// Whether the observations contradict what the log or the INI declares of a sensor. A map that was made with it is
  /// then likely wrong even if it is consistent.
  bool is_contradiction = false;
};

/// The findings that the user should know before the log is mapped, problems first.
std::vector<Finding> judge(const LogFacts& facts);

/// Lasers whose scans can be matched, because they have valid beams in a plane parallel to the floor. The laser with
/// the largest valid field of view comes first.
std::vector<std::string> usableLasers(const LogFacts& facts);
/// The odometry to use: of several, the one that agrees best with the scans. None if the log has no odometry, or if
/// none agrees with the scans.
std::optional<std::string> usableOdometry(const LogFacts& facts);
/// The aperture [rad] of a laser's scans according to the motions of the log; none if the declared aperture is right or
/// nothing shows that it is wrong.
std::optional<double> betterAperture(const LogFacts& facts, const std::string& laser);
/// base_from_sensor according to the motions of the log; none if the sensor pose in the log is right or nothing
/// determines a better one.
std::optional<mrpt::poses::CPose3D> betterSensorPose(const LogFacts& facts, const std::string& laser);

/// Time [s] to add to the stamps of the sensors whose clocks differ from those of the others, by label. Where a laser
/// and an odometry differ and nothing else tells which is right, the odometry's stamps are changed.
std::map<std::string, double> clockOffsets(const LogFacts& facts);

}  // namespace omnimapper::check

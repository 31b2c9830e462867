#pragma once

#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

enum class Weight {
  note,     ///< good to know
  warning,  ///< the map may suffer
  problem,  ///< without a remedy the map is likely wrong or empty
};

/// One sentence about a log.
struct Finding {
  Weight weight;
  std::string text;
};

/// What a user should know of the log before it is mapped, the heaviest first.
std::vector<Finding> judge(const LogFacts& facts);

/// Lasers whose scans can be matched, the best first: scans with valid beams, in a plane like the floor's.
std::vector<std::string> usableLasers(const LogFacts& facts);
/// The odometry to use, of several the one nearest to the scans; none if the scans contradict it.
std::optional<std::string> usableOdometry(const LogFacts& facts);
/// The aperture [rad] that a laser's scans have by the log's motions where they declare a wrong one.
std::optional<double> betterAperture(const LogFacts& facts, const std::string& laser);
/// base_from_sensor that the log's motions speak for where what is said of it is missing or wrong.
std::optional<mrpt::poses::CPose3D> betterSensorPose(const LogFacts& facts, const std::string& laser);

}  // namespace omnimapper::check

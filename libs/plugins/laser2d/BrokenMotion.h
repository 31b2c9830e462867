#pragma once

#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <vector>

namespace omnimapper::plugins {

/// Standard deviations of a motion that nobody measured: the base was carried, or pushed, while no scan came [m] [rad].
inline constexpr double kBrokenPosition = 6, kBrokenYaw = 1.5;

/// Tells motions from one key frame to the next that are far less certain than usual, such as across a gap in the
/// scans: scans before and after them are not joined to one local map.
class UsualMotion {
 public:
  /// Whether this motion is such; it then counts little for what is usual. `covariance`: of the motion.
  bool isWeak(const Eigen::Matrix<double, 6, 6>& covariance);

 private:
  double position_ = 0, yaw_ = 0;  // [m] [rad] running means of the standard deviations
};

/// Whether a motion is unknown. `covariance`: of the motion.
bool isBrokenMotion(const Eigen::Matrix<double, 6, 6>& covariance);

/// Name of the evidence of a broken motion; its value is the time after the first key frame of the session [s].
inline constexpr char kBrokenAfter[] = "broken_after_s";
/// For each broken motion of the map, whether closures have found out how the base moved, or against the map.
std::vector<mapper::Evidence> brokenMotions(const mapper::State& state);

}  // namespace omnimapper::plugins

#pragma once

#include <omnimapper/plugin/State.h>
#include <omnimapper/plugin/Verdict.h>

#include <vector>

namespace omnimapper::plugins {

/// Standard deviations of a motion that nobody measured: the base was carried, or pushed, while no scan came [m] [rad].
inline constexpr double kBrokenPosition = 6, kBrokenYaw = 1.5;

/// Whether the motion from a key frame to a later one is too uncertain for their scans to be joined to one local map;
/// `is_broken`: whether it is unknown. `covariance`: of that motion.
bool isWeakMotion(const Eigen::Matrix<double, 6, 6>& covariance);
bool isBrokenMotion(const Eigen::Matrix<double, 6, 6>& covariance);

/// Name of the evidence of a broken motion; its value is the time after the first key frame of the session [s].
inline constexpr char kBrokenAfter[] = "broken_after_s";
/// For each broken motion of the map, whether closures have found out how the base moved, or against the map.
std::vector<mapper::Evidence> brokenMotions(const mapper::State& state);

}  // namespace omnimapper::plugins

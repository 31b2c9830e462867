// What laser odometry reports at the end of a run.
#include <omnimapper/base/Numbers.h>
#include <omnimapper/matching/ScanInBase.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "BrokenMotion.h"
#include "EvidenceText.h"
#include "ScanOdometryPlugin.h"

namespace omnimapper::plugins {

// A tilted laser is not reported if a level one was used instead.
std::vector<std::string> ScanOdometryPlugin::warnings() const {
  std::vector<std::string> sentences;
  for (const auto& [label, tilted] : tilted_) {
    if (label_ && label != *label_) continue;
    const auto degrees = std::lround(tilted.tilt / base::option_text::kRadiansPerDegree);
    sentences.push_back(base::counted(tilted.scans, "scan") + " of the laser '" + label + "' " +
                        base::wasOrWere(tilted.scans) + " left out: by its sensor pose it is tilted by " +
                        std::to_string(degrees) + " deg, but it measures motion on a floor only up to " +
                        std::to_string(std::lround(matching::kLargestTilt / base::option_text::kRadiansPerDegree)) +
                        " deg; name a level laser as label, correct the sensor pose in [mapper] sensors, or remove " +
                        "the plugin from [mapper] pose_plugins");
  }
  return sentences;
}

std::vector<mapper::Evidence> ScanOdometryPlugin::evidence() const {
  constexpr double kMostBlind = 10;         // [%]
  constexpr double kMostContradicted = 1;   // [m]
  constexpr double kMovingWorthSaying = 1;  // [%]
  using Says = mapper::Evidence::Says;
  std::vector<mapper::Evidence> all;
  if (gaps_.count > 0) {
    all.push_back(
        {"laser_gaps_without_motion", static_cast<double>(gaps_.count), Says::too_little,
         evidenceText("neither scan matching nor odometry measured the motion across some gaps (%zu, the first "
                      "%.0f s after the start)",
                      gaps_.count, gaps_.first)});
  }
  for (const auto& odometry : odometries_) {
    constexpr double kWorthSaying = 0.03;  // [s]
    const double offset = odometry.clock.offset();
    if (std::abs(offset) < kWorthSaying) continue;
    all.push_back({"odometry_clock_offset_s", offset, Says::good,
                   evidenceText("the stamps of the odometry '%s' are %.2f s %s than those of the laser, which laser "
                                "odometry corrected",
                                odometry.label.c_str(), std::abs(offset), offset < 0 ? "earlier" : "later")});
  }
  // Which closures have found out how the base moved, LoopClosurePlugin knows.
  for (const double seconds : broken_) {
    all.push_back({kBrokenAfter, seconds, Says::too_little,
                   evidenceText("%.0f s after the start scans and wheels contradict each other across a gap: the base "
                                "was moved by hand",
                                seconds)});
  }
  if (moving_.points > 0) {
    const double share = 100 * static_cast<double>(moving_.points) / static_cast<double>(moving_.of_points);
    all.push_back(
        {"moving_points_percent", share, Says::good,
         share < kMovingWorthSaying
             ? ""
             : evidenceText("%.2g %% of the laser's points belong to things that moved, and were left out", share)});
  }
  if (frozen_.scans > 0) {
    all.push_back(
        {"frozen_scans", static_cast<double>(frozen_.scans), Says::good,
         evidenceText("%s of the laser, the first %.0f s after the start, repeated the ranges of an earlier one "
                      "although the wheels moved, and %s left out",
                      base::counted(frozen_.scans, "scan").c_str(), frozen_.first,
                      base::wasOrWere(frozen_.scans).c_str())});
  }
  if (contradiction_.contradictedSeconds() > 0) {
    const bool is_large = contradiction_.largest() > kMostContradicted;
    all.push_back(
        {"contradicted_by_odometry_s", contradiction_.contradictedSeconds(), is_large ? Says::too_little : Says::good,
         evidenceText("for %.1f s, the first time %.0f s after the start, scans and odometry contradicted each "
                      "other by up to %.1f m",
                      contradiction_.contradictedSeconds(), contradiction_.firstSeconds(), contradiction_.largest())});
  }
  const double percent = 100 * blind_seconds_ / std::max(blind_seconds_ + seeing_seconds_, 1e-9);
  if (percent > kMostBlind) {
    all.push_back(
        {"blind_along_percent", percent, Says::too_little,
         evidenceText("for %.0f %% of the time the walls left a direction of the motion unconstrained, and no "
                      "odometry measured it",
                      percent)});
  }
  return all;
}

}  // namespace omnimapper::plugins

#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/check/gatherFacts.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/check/proposeIni.h>
#include <omnimapper/testing/MemorySource.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <functional>
#include <string>
#include <vector>

/// Simulated logs that are spoilt by hand, with the findings on them and the proposed settings.
namespace omnimapper::check {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

inline constexpr double kPi = 3.14159265358979323846;

inline Observations halfALap(std::vector<testing::SimulatedLaser> lasers = {testing::SimulatedLaser()},
                             const std::function<void(testing::SimulatedLogOptions&)>& change = {}) {
  testing::SimulatedLogOptions options;
  options.laps = 0.5;
  options.lasers = std::move(lasers);
  if (change) change(options);
  return testing::SimulatedLog(options).observations();
}

/// Applies `change` to every observation of a class.
template <class Class>
void each(Observations& observations, const std::function<void(Class&)>& change) {
  for (const auto& observation : observations) {
    if (auto* found = dynamic_cast<Class*>(observation.get())) change(*found);
  }
}

struct Checked {
  LogFacts facts;
  std::vector<Finding> findings;
  std::vector<Setting> settings;

  explicit Checked(const Observations& observations) {
    testing::MemorySource source(observations);
    facts = gatherFacts(source);
    findings = judge(facts);
    settings = proposeIni(facts, {{"scan_odometry", "odometry", "no_motion"}, {"laser_points"}, {"loop_closure"}});
  }
  /// All findings, a line each.
  std::string text() const {
    const char* const weights[] = {"note: ", "warning: ", "problem: "};
    std::string text;
    for (const auto& finding : findings) text += weights[static_cast<int>(finding.weight)] + finding.text + "\n";
    return text;
  }
  bool says(const std::string& words) const { return text().find(words) != std::string::npos; }
  /// The value that is proposed for a key; empty if none is.
  std::string proposed(const std::string& section, const std::string& key) const {
    for (const auto& setting : settings) {
      if (setting.section == section && setting.key == key) return setting.value;
    }
    return "";
  }
};

}  // namespace omnimapper::check

#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/motion/Gravity.h>

#include <map>
#include <string>

namespace omnimapper::plugins {

/// Collects from all observations, not only those of key frames, the evidence for which way is up.
class LevelEvidence {
 public:
  /// Adds an observation, which must have its final sensor pose.
  void add(const mrpt::obs::CObservation& observation);
  /// The steady spans of each inertial sensor, by label.
  const std::map<std::string, motion::SteadySpans>& imus() const { return imus_; }
  /// Why the robot is assumed to run on wheels: the name of its wheel odometry or of a laser that scans a level plane;
  /// empty if it has neither.
  const std::string& levelBase() const { return level_base_; }

 private:
  std::map<std::string, motion::SteadySpans> imus_;
  std::string level_base_;
};

}  // namespace omnimapper::plugins

#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/matching/Gravity.h>

#include <map>
#include <string>

namespace omnimapper::mapper {

/// What the stream of observations tells of which way is up, key frames or not.
class LevelEvidence {
 public:
  /// Takes an observation with its final sensor pose.
  void add(const mrpt::obs::CObservation& observation);
  /// Of each inertial sensor, by label.
  const std::map<std::string, matching::SteadySpans>& imus() const { return imus_; }
  /// What makes it a robot on wheels: wheel odometry, or a laser that scans a level plane; empty if nothing does.
  const std::string& levelBase() const { return level_base_; }

 private:
  std::map<std::string, matching::SteadySpans> imus_;
  std::string level_base_;
};

}  // namespace omnimapper::mapper

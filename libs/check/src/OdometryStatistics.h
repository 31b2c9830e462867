#pragma once

#include <mrpt/poses/CPose2D.h>
#include <omnimapper/check/LogFacts.h>
#include <omnimapper/motion/WheelOdometry.h>

#include <optional>
#include <string>
#include <vector>

#include "ClockFit.h"

namespace omnimapper::check {

/// Statistics on the odometry of one label, and its motion between two times as the mapper would compute it.
class OdometryStatistics {
 public:
  /// Whether the observation is odometry.
  static bool isOdometry(const mrpt::obs::CObservation& observation);
  void add(const mrpt::obs::CObservation& observation);
  const OdometryFacts& facts() const { return facts_; }
  std::optional<mrpt::poses::CPose2D> between(base::Stamp begin, base::Stamp end) const;
  Headings headings() const;
  /// Valid stamps of its readings, in order of arrival.
  const std::vector<base::Stamp>& stamps() const { return stamps_; }

 private:
  void addStep(const mrpt::poses::CPose2D& step, double seconds, base::Stamp stamp);

  OdometryFacts facts_;
  std::optional<mrpt::poses::CPose2D> previous_;
  base::Stamp previous_stamp_;
  std::vector<base::Stamp> stamps_;
  motion::WheelOdometry source_{motion::WheelOdometryOptions()};
};

/// Compares two odometries over spans of a second or more that begin and end with readings of the one that has fewer;
/// in a long log over some hundred spans.
OdometryPair compareOdometries(const std::string& a, const OdometryStatistics& of_a, const std::string& b,
                               const OdometryStatistics& of_b);

}  // namespace omnimapper::check

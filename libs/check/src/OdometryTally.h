#pragma once

#include <mrpt/poses/CPose2D.h>
#include <omnimapper/check/LogFacts.h>
#include <omnimapper/plugins/OdometryPlugin.h>

#include <memory>
#include <optional>

namespace omnimapper::check {

/// Counts the odometry of one label, and answers for the motion as the mapper would have it.
class OdometryTally {
 public:
  OdometryTally() : source_(std::make_unique<plugins::OdometryPlugin>(plugins::OdometryOptions())) {}

  /// Whether it is odometry at all.
  static bool isOdometry(const mrpt::obs::CObservation& observation);
  void add(const mrpt::obs::CObservation& observation);
  const OdometryFacts& facts() const { return facts_; }
  std::optional<mrpt::poses::CPose2D> between(base::Stamp begin, base::Stamp end) const;

 private:
  void addStep(const mrpt::poses::CPose2D& step, double seconds, base::Stamp stamp);

  OdometryFacts facts_;
  std::optional<mrpt::poses::CPose2D> previous_;
  base::Stamp previous_stamp_;
  std::unique_ptr<plugins::OdometryPlugin> source_;
};

}  // namespace omnimapper::check

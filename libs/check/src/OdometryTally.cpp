#include "OdometryTally.h"

#include <cmath>

namespace omnimapper::check {

namespace {
constexpr double kJump = 0.5;        // [m]
constexpr double kFastestRobot = 5;  // [m/s]

bool isFinite(const mrpt::poses::CPose2D& pose) {
  return std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.phi());
}
}  // namespace

bool OdometryTally::isOdometry(const mrpt::obs::CObservation& observation) {
  return dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation) ||
         dynamic_cast<const obs::CObservationRelativeMotion*>(&observation);
}

void OdometryTally::add(const mrpt::obs::CObservation& observation) {
  ++facts_.readings;
  source_->add(observation);
  const auto stamp = observation.timestamp;
  if (const auto* motion = dynamic_cast<const obs::CObservationRelativeMotion*>(&observation)) {
    const mrpt::poses::CPose2D step(motion->begin_from_end);
    if (!isFinite(step)) {
      ++facts_.not_finite;
    } else {
      addStep(step, base::secondsBetween(motion->begin, stamp), stamp);
    }
    return;
  }
  const auto& pose = dynamic_cast<const mrpt::obs::CObservationOdometry&>(observation).odometry;
  if (!isFinite(pose)) {
    ++facts_.not_finite;
    return;
  }
  if (previous_) addStep(pose - *previous_, base::secondsBetween(previous_stamp_, stamp), stamp);
  previous_ = pose;
  previous_stamp_ = stamp;
}

void OdometryTally::addStep(const mrpt::poses::CPose2D& step, double seconds, base::Stamp stamp) {
  const double way = step.norm();
  if (way > kJump + kFastestRobot * std::abs(seconds)) {
    ++facts_.jumps;
    if (way > facts_.largest_jump) {
      facts_.largest_jump = way;
      facts_.largest_at = stamp;
    }
    return;
  }
  facts_.way += way;
  facts_.turn += std::abs(step.phi());
}

std::optional<mrpt::poses::CPose2D> OdometryTally::between(base::Stamp begin, base::Stamp end) const {
  const auto motion = source_->between(begin, end);
  if (!motion) return std::nullopt;
  return mrpt::poses::CPose2D(motion->begin_from_end);
}

}  // namespace omnimapper::check

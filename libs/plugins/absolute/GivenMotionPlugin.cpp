#include "GivenMotionPlugin.h"

#include <omnimapper/obs/GivenPose.h>

#include <iterator>

namespace omnimapper::plugins {

const base::OptionTable<GivenMotionOptions>& GivenMotionOptions::table() {
  using Options = GivenMotionOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("label", &Options::label,
                "Sensor label of the poses; empty for the label of the first pose in the log.")
          .number("max_gap_s", &Options::max_gap, base::Range::positive(),
                  "Longest time between two poses at which the motion from one to the other counts as known.")
          .number("position_sigma_m", &Options::position_sigma, base::Range::positive(),
                  "Standard deviation of each coordinate of the motion after 1 s; it grows "
                  "with the root of time.")
          .number("angle_sigma_deg", &Options::angle_sigma, base::Range::positive(),
                  "Standard deviation of each angle of the motion after 1 s; it grows with "
                  "the root of time.");
  return table;
}

// Inserts the pose between those before and after it, in any order of arrival.
GivenMotionPlugin::Taken GivenMotionPlugin::add(const mrpt::obs::CObservation::ConstPtr& observation) {
  news_.reset();
  const auto* given = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observation.get());
  if (!given || (!options_.label.empty() && given->sensorLabel != options_.label)) return Taken::not_mine;
  if (!label_) label_ = given->sensorLabel;
  if (given->sensorLabel != *label_) return Taken::not_mine;
  const auto pose = obs::referenceFromBase(*given);
  if (!pose) return Taken::unusable;
  const auto after = poses_.lower_bound(given->timestamp);
  if (after != poses_.end() && after->first == given->timestamp) return Taken::unusable;
  if (after == poses_.begin() && forgotten_) return Taken::unusable;
  const auto added = poses_.emplace_hint(after, given->timestamp, *pose);
  news_ = Span{added->first, added->first};
  if (added != poses_.begin()) {
    const auto before = std::prev(added);
    if (after != poses_.end()) timeline_.remove(before->first, after->first);
    addMotion(*before, *added);
    news_->begin = before->first;
  }
  if (after != poses_.end()) {
    addMotion(*added, *after);
    news_->end = after->first;
  }
  return Taken::taken;
}

void GivenMotionPlugin::addMotion(const Poses::value_type& begin, const Poses::value_type& end) {
  const double seconds = base::secondsBetween(begin.first, end.first);
  if (seconds > options_.max_gap) return;
  mapper::RelativeMotion motion{end.second - begin.second, Eigen::Matrix<double, 6, 6>::Zero()};
  motion.covariance.diagonal().head<3>().setConstant(options_.position_sigma * options_.position_sigma * seconds);
  motion.covariance.diagonal().tail<3>().setConstant(options_.angle_sigma * options_.angle_sigma * seconds);
  timeline_.insert(begin.first, end.first, motion);
}

std::optional<base::Stamp> GivenMotionPlugin::coveredUntil() const {
  if (poses_.empty()) return std::nullopt;
  return poses_.rbegin()->first;
}

// The last pose before `stamp` is kept, because a late pose may follow it.
void GivenMotionPlugin::forgetBefore(base::Stamp stamp) {
  timeline_.forgetBefore(stamp);
  while (poses_.size() > 1 && std::next(poses_.begin())->first <= stamp) {
    poses_.erase(poses_.begin());
    forgotten_ = true;
  }
}

}  // namespace omnimapper::plugins

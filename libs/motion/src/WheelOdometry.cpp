#include <omnimapper/base/Numbers.h>
#include <omnimapper/motion/WheelOdometry.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::motion {

bool WheelOdometry::isOurs(const mrpt::obs::CObservation& observation) {
  if (!options_.label.empty()) return observation.sensorLabel == options_.label;
  if (!label_) label_ = observation.sensorLabel;
  return observation.sensorLabel == *label_;
}

Eigen::Matrix<double, 6, 6> WheelOdometry::covarianceOf(const mrpt::poses::CPose3D& motion, double seconds) const {
  const double travel = motion.translation().norm();
  const double turn = std::abs(motion.yaw());
  const auto squared = [](double value) { return value * value; };
  const double position =
      squared(options_.position_noise_per_root_m) * travel + squared(options_.position_noise_per_root_s) * seconds;
  const double yaw = squared(options_.yaw_noise_per_root_turn) * turn +
                     squared(options_.yaw_noise_per_root_m) * travel + squared(options_.yaw_noise_per_root_s) * seconds;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  covariance.diagonal() << position, position, position, yaw, yaw, yaw;
  return covariance;
}

WheelOdometry::Taken WheelOdometry::add(const mrpt::obs::CObservation& observation) {
  news_.reset();
  if (const auto* motion = dynamic_cast<const obs::CObservationRelativeMotion*>(&observation)) {
    return isOurs(observation) ? addMotion(*motion) : Taken::not_mine;
  }
  if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    return isOurs(observation) ? addPose(*odometry) : Taken::not_mine;
  }
  return Taken::not_mine;
}

WheelOdometry::Taken WheelOdometry::addMotion(const obs::CObservationRelativeMotion& motion) {
  const double seconds = base::secondsBetween(motion.begin, motion.timestamp);
  if (isImpossible(motion.begin_from_end, seconds)) return Taken::unusable;
  const auto covariance =
      options_.use_reported_covariance ? motion.covariance : covarianceOf(motion.begin_from_end, seconds);
  if (!timeline_.insert(motion.begin, motion.timestamp, {motion.begin_from_end, covariance})) return Taken::unusable;
  news_ = Span{motion.begin, motion.timestamp};
  return Taken::taken;
}

// A single wrong stamp must not make all later readings too old, so a leap in time counts only once the next reading
// confirms it.
bool WheelOdometry::isUnconfirmedLeap(base::Stamp stamp) {
  constexpr double kLeapSeconds = 60;
  const auto leaps = [&](base::Stamp from) { return base::secondsBetween(from, stamp) > kLeapSeconds; };
  if (!leaps(readings_.rbegin()->first)) {
    leap_.reset();
    return false;
  }
  const bool confirmed = leap_ && stamp > *leap_ && !leaps(*leap_);
  leap_ = stamp;
  return !confirmed;
}

WheelOdometry::Taken WheelOdometry::addPose(const mrpt::obs::CObservationOdometry& odometry) {
  const auto& pose = odometry.odometry;
  if (!std::isfinite(pose.x()) || !std::isfinite(pose.y()) || !std::isfinite(pose.phi())) return Taken::unusable;
  const mrpt::poses::CPose3D odom_from_base(pose);
  if (!readings_.empty()) {
    const auto& [last, odom_from_last] = *readings_.rbegin();
    if (odometry.timestamp <= last) return addLatePose(odometry.timestamp, odom_from_base);
    if (isUnconfirmedLeap(odometry.timestamp)) return Taken::unusable;
    insertMotion(last, odometry.timestamp, odom_from_base - odom_from_last);
    news_ = Span{last, odometry.timestamp};
  }
  readings_.emplace(odometry.timestamp, odom_from_base);
  return Taken::taken;
}

// Inserts a reading that arrived after a later one between its neighbours, if its pose lies on the path between theirs.
// If it does not, the robot's clock was set back rather than the reading delayed, and the reading is unusable.
WheelOdometry::Taken WheelOdometry::addLatePose(base::Stamp stamp, const mrpt::poses::CPose3D& odom_from_base) {
  constexpr double kLongestDetour = 0.2;  // [m]
  constexpr double kLargestTurn = 0.5;    // [rad] there and back
  const auto after = readings_.lower_bound(stamp);
  if (after->first == stamp) return Taken::unusable;
  const mrpt::poses::CPose3D to_after = after->second - odom_from_base;
  if (after == readings_.begin()) {
    if (forgotten_) return Taken::unusable;
    insertMotion(stamp, after->first, to_after);
    news_ = Span{stamp, after->first};
  } else {
    const auto before = std::prev(after);
    const mrpt::poses::CPose3D from_before = odom_from_base - before->second;
    const double detour = from_before.norm() + to_after.norm() - (after->second - before->second).norm();
    const double turn =
        std::abs(from_before.yaw()) + std::abs(to_after.yaw()) - std::abs((after->second - before->second).yaw());
    if (detour > kLongestDetour || turn > kLargestTurn) return Taken::unusable;
    if (!timeline_.remove(before->first, after->first)) return Taken::unusable;
    insertMotion(before->first, stamp, from_before);
    insertMotion(stamp, after->first, to_after);
    news_ = Span{before->first, after->first};
  }
  readings_.emplace(stamp, odom_from_base);
  return Taken::taken;
}

// Adds the motion between two readings. An odometry that continues from another pose than before has not moved there,
// so such a span is left without a motion.
void WheelOdometry::insertMotion(base::Stamp begin, base::Stamp end, const mrpt::poses::CPose3D& motion) {
  const double seconds = base::secondsBetween(begin, end);
  if (!isImpossible(motion, seconds)) timeline_.insert(begin, end, {motion, covarianceOf(motion, seconds)});
}

bool WheelOdometry::isImpossible(const mrpt::poses::CPose3D& motion, double seconds) {
  constexpr double kFastest = 100, kSlack = 10;  // [m/s], and [m] for stamps that are not exact
  const double travel = motion.norm();
  if (travel <= kSlack + kFastest * seconds) return false;
  ++impossible_;
  farthest_ = std::max(farthest_, travel);
  return true;
}

std::vector<std::string> WheelOdometry::warnings() const {
  if (impossible_ == 0) return {};
  return {"the odometry leaps " + base::counted(impossible_, "time") + ", by up to " + base::brief(farthest_) +
          " m, which is farther than a vehicle drives in that time; these motions are left out. Cut the log there "
          "([source] " +
          "start_s, end_s), or measure the motion with another sensor"};
}

// Keeps the last reading before `stamp`, because a late one may follow it.
void WheelOdometry::forgetBefore(base::Stamp stamp) {
  timeline_.forgetBefore(stamp);
  while (readings_.size() > 1 && std::next(readings_.begin())->first <= stamp) {
    readings_.erase(readings_.begin());
    forgotten_ = true;
  }
}

std::optional<RelativeMotion> WheelOdometry::between(base::Stamp begin, base::Stamp end) const {
  return timeline_.between(begin, end);
}

}  // namespace omnimapper::motion

#include "CameraOdometry.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omnimapper::plugins {

using mrpt::obs::CObservation3DRangeScan;
using How = ImageMotion::How;

const base::OptionTable<CameraOdometryOptions>& CameraOdometryOptions::table() {
  using Options = CameraOdometryOptions;
  const auto zero_or_more = base::Range::notNegative();
  static const auto table =
      base::OptionTable<Options>()
          .text("label", &Options::label, "Sensor label of the camera; empty for the first camera in the log.")
          .text("odometry_label", &Options::odometry_label,
                "Sensor label of the wheel odometry by which motions are predicted; empty for the first one in the "
                "log, if there is one. An OdometryPlugin for the same wheels needs fallback = true.")
          .text("imu_label", &Options::imu_label,
                "Sensor label of the inertial sensor by whose turn rates rotations are predicted; empty for the first "
                "one in the log, if there is one.")
          .number("turn_rate_noise_per_root_s_deg", &Options::turn_rate_noise, base::Range::positive(),
                  "Standard deviation of the rotation that the inertial sensor measures in 1 s; it grows with the "
                  "root of time.")
          .number("turn_rate_bias_per_s_deg", &Options::turn_rate_bias, zero_or_more,
                  "Standard deviation of the inertial sensor's bias before the bias is estimated. The bias is the turn "
                  "rate that the sensor reports at rest.")
          .number("max_speed_m_per_s", &Options::max_speed, base::Range::positive(),
                  "Largest plausible speed of a camera that a hand or a robot moves; a map with faster motions is "
                  "reported as suspicious.")
          .number("position_noise_m", &Options::position_noise, base::Range::positive(),
                  "Standard deviation of each coordinate of the measured motion from one image to the next while the "
                  "camera rests.")
          .number("angle_noise_deg", &Options::angle_noise, base::Range::positive(),
                  "Standard deviation of each angle of the measured motion from one image to the next while the camera "
                  "rests.")
          .number("position_noise_per_root_m", &Options::position_noise_per_root_m, zero_or_more,
                  "Additional standard deviation of each coordinate after 1 m of distance travelled [m]; it grows with "
                  "the square root of the distance.")
          .number("position_noise_per_root_turn", &Options::position_noise_per_root_turn, zero_or_more,
                  "Additional standard deviation of each coordinate after 1 rad of rotation [m]; it grows with the "
                  "square root of the angle.")
          .number("angle_noise_per_root_m_deg", &Options::angle_noise_per_root_m, zero_or_more,
                  "Additional standard deviation of each angle after 1 m of distance travelled; it grows with the "
                  "square root of the distance.")
          .number("angle_noise_per_root_turn", &Options::angle_noise_per_root_turn, zero_or_more,
                  "Additional standard deviation of each angle after 1 rad of rotation [rad]; it grows with the square "
                  "root of the angle.");
  return table;
}

namespace {

// Variance of the motion in directions that nothing measures: a hand may change its motion at any time. The speed is
// correlated over kWhile; a variance that grows linearly with time gives the right sum over several spans.
double unconstrainedVariance(base::Stamp begin, base::Stamp end) {
  constexpr double kUsualSpeed = 0.5, kWhile = 1;  // [m/s] and [rad/s]; [s]
  return kUsualSpeed * kUsualSpeed * kWhile * base::secondsBetween(begin, end);
}

motion::WheelOdometryOptions wheelsOf(const std::string& label) {
  motion::WheelOdometryOptions wheels;
  wheels.label = label;
  return wheels;
}

}  // namespace

CameraOdometry::CameraOdometry(const CameraOdometryOptions& options, std::string what)
    : options_(options),
      what_(std::move(what)),
      wheels_(wheelsOf(options.odometry_label)),
      gyroscope_({options.imu_label, options.turn_rate_noise, options.turn_rate_bias}) {}

CameraOdometry::Taken CameraOdometry::add(const mrpt::obs::CObservation::ConstPtr& observation) {
  const auto scan = std::dynamic_pointer_cast<const CObservation3DRangeScan>(observation);
  if (!scan) {
    wheels_.add(*observation);
    gyroscope_.add(*observation);
  }
  if (!scan || !scan->hasRangeImage) return Taken::not_mine;
  if (!options_.label.empty() && scan->sensorLabel != options_.label) return Taken::not_mine;
  if (label_ && scan->sensorLabel != *label_) return Taken::not_mine;
  label_ = scan->sensorLabel;
  if (!reached_ || scan->timestamp > *reached_) queue_.emplace(scan->timestamp, scan);
  return Taken::taken;
}

std::optional<base::Stamp> CameraOdometry::coveredUntil() const {
  if (!queue_.empty()) return queue_.rbegin()->first;
  return reached_;
}

// Processes one image beyond `stamp`, so that the motion to a stamp between two images is known.
void CameraOdometry::processUntil(base::Stamp stamp) {
  while (!queue_.empty() && (!reached_ || *reached_ < stamp)) {
    const auto next = queue_.extract(queue_.begin());
    reached_ = next.key();
    follow(next.mapped());
  }
  constexpr double kRemembered = 1;  // [s]
  const auto forgotten = last_.value_or(stamp) - base::durationFromSeconds(kRemembered);
  wheels_.forgetBefore(forgotten);
  gyroscope_.forgetBefore(turn_begun_ ? std::min(*turn_begun_, forgotten) : forgotten);
}

void CameraOdometry::share(const mrpt::obs::CObservation& observation, perception::Blackboard& board) const {
  if (newest_ && newest_->isOf(observation)) StraightImage::share(newest_, board);
}

// An image may arrive before the next reading of the wheels, whose last motion is then extrapolated.
std::optional<mapper::RelativeMotion> CameraOdometry::wheelsBetween(base::Stamp begin, base::Stamp end) const {
  constexpr double kLongestLag = 0.2, kAcceleration = 1, kTurnAcceleration = 2;  // [s] [m/s2] [rad/s2]
  if (auto measured = wheels_.between(begin, end)) return measured;
  const auto covered = wheels_.coveredUntil();
  if (!covered || *covered >= end) return std::nullopt;
  const double lag = base::secondsBetween(*covered, end), seconds = base::secondsBetween(begin, end);
  if (lag > kLongestLag || seconds > kLongestLag) return std::nullopt;
  auto measured = wheels_.between(*covered - base::durationFromSeconds(seconds), *covered);
  if (!measured) return std::nullopt;
  measured->covariance.diagonal().head<3>().array() += std::pow(kAcceleration * lag * seconds, 2);
  measured->covariance.diagonal().tail<3>().array() += std::pow(kTurnAcceleration * lag * seconds, 2);
  return measured;
}

std::optional<CameraOdometry::BaseMotion> CameraOdometry::measuredBetween(base::Stamp begin, base::Stamp end) const {
  const auto wheels = wheelsBetween(begin, end);
  const auto turn = gyroscope_.between(begin, end);
  if (!wheels && !turn) return std::nullopt;
  BaseMotion motion;
  motion.only_turn = !wheels;
  if (wheels) {
    motion.begin_from_end = geometry::fromMrpt(wheels->begin_from_end);
    motion.covariance = wheels->covariance;
  }
  if (turn) {
    motion.begin_from_end.rotation = turn->begin_from_end;
    motion.covariance.rightCols<3>().setZero();
    motion.covariance.bottomRows<3>().setZero();
    motion.covariance.bottomRightCorner<3, 3>() = turn->covariance;
  }
  return motion;
}

std::optional<motion::PredictedMotion> CameraOdometry::predictionOf(const geometry::Se3& base_from_camera,
                                                                    base::Stamp stamp) const {
  constexpr double kStampError = 0.02;                 // [s] between the clocks of wheels and images
  constexpr double kPosition = 0.002, kAngle = 0.002;  // [m] [rad] as a base also pitches and sways
  const auto measured = last_ ? measuredBetween(*last_, stamp) : std::nullopt;
  if (!measured) return std::nullopt;
  const geometry::Se3& motion = measured->begin_from_end;
  const geometry::Vector6d shifted =
      minus(motion, geometry::Se3{}) * (kStampError / std::max(kStampError, base::secondsBetween(*last_, stamp)));
  geometry::Matrix6d covariance = measured->covariance + shifted * shifted.transpose();
  covariance.diagonal().head<3>().array() +=
      measured->only_turn ? unconstrainedVariance(*last_, stamp) : kPosition * kPosition;
  covariance.diagonal().tail<3>().array() += kAngle * kAngle;
  const geometry::Se3 camera_from_base = inverse(base_from_camera);
  const geometry::Matrix6d ad = adjoint(camera_from_base);
  return motion::PredictedMotion{camera_from_base * motion * base_from_camera, ad * covariance * ad.transpose(),
                                 measured->only_turn};
}

// Estimates the gyroscope's bias over a second or so, because images share the error of the key frame they were
// registered with. An image that shows an earlier view again is left out, because it corrects all drift at once, which
// would look like a rotation.
void CameraOdometry::learnBias(const ImageMotion& tracked, base::Stamp stamp, const geometry::Se3& base_from_camera) {
  constexpr double kWhile = 1;      // [s]
  constexpr double kAngle = 0.005;  // [rad]
  if (tracked.how != How::tracked || tracked.seen_before || !tracked.open.isZero()) {
    turn_begun_.reset();
    return;
  }
  if (!turn_begun_) {
    turn_begun_ = tracked.last;
    turned_.setIdentity();
  }
  const auto& base_from_lens = base_from_camera.rotation;
  turned_ = turned_ * base_from_lens * tracked.last_from_camera.rotation * base_from_lens.conjugate();
  if (base::secondsBetween(*turn_begun_, stamp) < kWhile) return;
  gyroscope_.learn(*turn_begun_, stamp, turned_, kAngle);
  turn_begun_.reset();
}

void CameraOdometry::follow(const CObservation3DRangeScan::ConstPtr& image) {
  const auto& scan = *image;
  const geometry::Se3 base_from_camera = geometry::fromMrpt(scan.sensorPose) * geometry::sensorFromOptical();
  const auto prediction = predictionOf(base_from_camera, scan.timestamp);
  ImageMotion tracked;
  newest_.reset();
  try {
    auto straight = std::make_shared<const StraightImage>(image, lens_);
    tracked = track(*straight, scan.timestamp, prediction);
    newest_ = std::move(straight);
  } catch (const base::Error& error) {
    if (unreadable_++ == 0) why_unreadable_ = error.what();
    return;
  }
  constexpr std::size_t kRunaway = 3;  // images in a row; a single one may be due to a change of the key frame
  constexpr double kShortest = 0.03;   // [s] between stamps that nearly coincide noise would look like speed
  if (!begun_) begun_ = scan.timestamp;
  ++images_;
  learnBias(tracked, scan.timestamp, base_from_camera);
  const bool by_wheels = prediction && !prediction->only_turn;
  if (tracked.seen_before) loops_.emplace_back(*tracked.seen_before, scan.timestamp);
  if (tracked.how == How::lost) {
    ++lost_;
    is_lost_ = true;
    if (last_) lost_images_.push_back(scan.timestamp);
    return;
  }
  if (tracked.how == How::begun) {
    const bool is_gap = has_begun_ && !bridgeByWheels(scan.timestamp);
    if (is_gap && gaps_++ == 0) first_gap_ = base::secondsBetween(*begun_, scan.timestamp);
    has_begun_ = true;
  } else {
    const double seconds = base::secondsBetween(tracked.last, scan.timestamp);
    const bool is_hasty =
        tracked.last_from_camera.translation.norm() > options_.max_speed * std::max(seconds, kShortest);
    hasty_in_a_row_ = is_hasty ? hasty_in_a_row_ + 1 : 0;
    runaways_ += hasty_in_a_row_ == kRunaway;
    // Even a view that fits well may be of another place that looks alike, such as another bare wall.
    constexpr double kLong = 0.4;  // [s]
    found_ += !by_wheels && is_lost_ && seconds > kLong;
    bridged_ += !by_wheels && !tracked.open.isZero();
    addMotion(tracked.last, scan.timestamp, motionOf(tracked, scan.timestamp, base_from_camera, prediction));
  }
  last_ = scan.timestamp;
  is_lost_ = false;
  lost_images_.clear();
}

// Across lost images the base moved as wheels or gyroscope measured it. Their error at the end is distributed evenly
// over time, that of the translation along a straight line in the base at the beginning.
void CameraOdometry::addMotion(base::Stamp begin, base::Stamp end, const mapper::RelativeMotion& motion) {
  std::vector<base::Stamp> stamps{begin};
  stamps.insert(stamps.end(), lost_images_.begin(), lost_images_.end());
  stamps.push_back(end);
  std::vector<geometry::Se3> begin_from{{}};  // pose of the base at each stamp
  for (std::size_t i = 1; i < stamps.size() && stamps.size() > 2 && begin_from.size() == i; ++i) {
    if (const auto measured = measuredBetween(stamps[i - 1], stamps[i]))
      begin_from.push_back(begin_from.back() * measured->begin_from_end);
  }
  if (begin_from.size() < stamps.size()) {
    timeline_.insert(begin, end, motion);
    return;
  }
  const double seconds = base::secondsBetween(begin, end);
  const geometry::Se3 begin_from_end = geometry::fromMrpt(motion.begin_from_end), last = begin_from.back();
  const Eigen::Vector3d moved = begin_from_end.translation - last.translation;
  const Eigen::Vector3d turned = geometry::logSo3(last.rotation.conjugate() * begin_from_end.rotation);
  geometry::Se3 begin_from_before;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double until = base::secondsBetween(begin, stamps[i]) / seconds;
    const double share = base::secondsBetween(stamps[i - 1], stamps[i]) / seconds;
    const geometry::Se3 here{(begin_from[i].rotation * geometry::expSo3(until * turned)).normalized(),
                             begin_from[i].translation + until * moved};
    timeline_.insert(stamps[i - 1], stamps[i],
                     {geometry::toMrpt(inverse(begin_from_before) * here),
                      geometry::composeCovariance(share * motion.covariance, inverse(begin_from_end) * here,
                                                  geometry::Matrix6d::Zero())});
    begin_from_before = here;
  }
}

// Adds the motion of the wheels from image to image, because a robot does not move uniformly while its camera is lost.
// False, and nothing is added, if the wheels do not cover the whole gap.
bool CameraOdometry::bridgeByWheels(base::Stamp stamp) {
  if (!last_) return false;
  std::vector<std::pair<base::Stamp, mapper::RelativeMotion>> measured;
  auto from = *last_;
  lost_images_.push_back(stamp);
  for (const auto& to : lost_images_) {
    const auto motion = wheelsBetween(from, to);
    if (!motion) return false;
    measured.emplace_back(std::exchange(from, to), *motion);
  }
  for (std::size_t i = 0; i < measured.size(); ++i)
    timeline_.insert(measured[i].first, lost_images_[i], measured[i].second);
  return true;
}

// Variances grow linearly with distance and rotation, so that those of consecutive spans add up: the error of a key
// frame counts once for all images that were registered with it.
mapper::RelativeMotion CameraOdometry::motionOf(const ImageMotion& tracked, base::Stamp stamp,
                                                const geometry::Se3& base_from_camera,
                                                const std::optional<motion::PredictedMotion>& prediction) const {
  const geometry::Se3& moved = tracked.last_from_camera;
  const double travel = moved.translation.norm(), turn = geometry::logSo3(moved.rotation).norm();
  const auto variance = [&](double at_rest, double per_root_m, double per_root_turn) {
    return at_rest * at_rest + per_root_m * per_root_m * travel + per_root_turn * per_root_turn * turn;
  };
  geometry::Matrix6d of_camera = geometry::Matrix6d::Zero();
  of_camera.diagonal().head<3>().setConstant(
      variance(options_.position_noise, options_.position_noise_per_root_m, options_.position_noise_per_root_turn));
  of_camera.diagonal().tail<3>().setConstant(
      variance(options_.angle_noise, options_.angle_noise_per_root_m, options_.angle_noise_per_root_turn));
  if (prediction) {
    of_camera += tracked.open * prediction->covariance * tracked.open;
  } else {
    of_camera += unconstrainedVariance(tracked.last, stamp) * tracked.open;
  }
  const geometry::Matrix6d ad = adjoint(base_from_camera);
  return {geometry::toMrpt(base_from_camera * moved * inverse(base_from_camera)), ad * of_camera * ad.transpose()};
}

std::vector<std::string> CameraOdometry::warnings() const {
  std::vector<std::string> all;
  if (unreadable_ > 0) {
    all.push_back(base::counted(unreadable_, "image") + " of the camera " + base::sensorName(*label_) +
                  " could not be used for " + what_ + ": " + why_unreadable_);
  }
  return all;
}

std::vector<mapper::Evidence> CameraOdometry::evidence() const {
  constexpr double kMuch = 10;  // [%]
  const double percent = images_ == 0 ? 0 : 100.0 * static_cast<double>(lost_) / static_cast<double>(images_);
  std::vector<mapper::Evidence> all;
  char text[200];
  if (gaps_ > 0) {
    std::snprintf(text, sizeof text,
                  "the camera was lost and its tracking started anew (%s, first %.0f s after the start)",
                  base::counted(gaps_, "time").c_str(), first_gap_);
    all.push_back({"camera_begun_anew", static_cast<double>(gaps_), mapper::Evidence::Says::against_it, text});
  }
  if (images_ == 0) return all;
  using Says = mapper::Evidence::Says;
  std::snprintf(text, sizeof text, "%s was lost in %.0f %% of the images", what_.c_str(), percent);
  all.push_back(
      {"camera_lost_percent", percent, percent > kMuch ? Says::too_little : Says::good, percent > kMuch ? text : ""});
  if (found_ > 0) {
    std::snprintf(text, sizeof text,
                  "the camera was lost, and only a view that looks like an earlier one showed where it was (%s)",
                  base::counted(found_, "time").c_str());
    all.push_back({"camera_found_again", static_cast<double>(found_), Says::too_little, text});
  }
  if (runaways_ > 0) {
    std::snprintf(text, sizeof text, "the camera was tracked at more than %.1f m/s (%s), so its motion is wrong there",
                  options_.max_speed, base::counted(runaways_, "time").c_str());
    all.push_back({"camera_runaways", static_cast<double>(runaways_), Says::against_it, text});
  }
  const double open = 100.0 * static_cast<double>(bridged_) / static_cast<double>(images_);
  std::snprintf(text, sizeof text, "%.0f %% of the images left a direction of the camera's motion unconstrained", open);
  all.push_back({"camera_blind_percent", open, open > kMuch ? Says::too_little : Says::good, open > kMuch ? text : ""});
  auto returns = returnEvidence(loops_, *begun_, last_.value_or(*begun_));
  if (!seeksReturns())
    returns.back().reason = "odometry by clouds does not look for earlier views, which would reveal drift";
  all.insert(all.end(), returns.begin(), returns.end());
  return all;
}

}  // namespace omnimapper::plugins

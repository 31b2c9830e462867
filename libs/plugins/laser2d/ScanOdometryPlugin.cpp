#include "ScanOdometryPlugin.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/matching/ScanInBase.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "PlanarMotion.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

namespace {

// Position of the laser on the base [m].
Eigen::Vector2f placeOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  return {static_cast<float>(scan.sensorPose.x()), static_cast<float>(scan.sensorPose.y())};
}

constexpr double kAlsoNear = 0.02;  // [m] more than the distance between points, within which beams end on the same

TPose2D perSecond(const TPose2D& motion, double seconds) {
  return {motion.x / seconds, motion.y / seconds, mrpt::math::wrapToPi(motion.phi) / seconds};
}

}  // namespace

const base::OptionTable<ScanOdometryOptions>& ScanOdometryOptions::table() {
  using Options = ScanOdometryOptions;
  const auto zero_or_more = base::Range::notNegative();
  static const auto table =
      base::OptionTable<Options>()
          .text("label", &Options::label, "Sensor label of the laser; empty for the first laser in the log.")
          .text("odometry_label", &Options::odometry_label,
                "Sensor label of the odometry by which motions are predicted; empty for the one that agrees best with "
                "the matches of scans.")
          .number(
              "sweep_s", &Options::sweep, zero_or_more,
              "Time from a scan's first beam to its last one; 0 if all beams are simultaneous. The stamp of the scan "
              "is the time of its first beam, and the scan is corrected for the motion of the base during this time.")
          .number("max_gap_s", &Options::max_gap, base::Range::positive(),
                  "If no scan could be matched for longer than this, scan matching starts anew, and other sources give "
                  "the motion in between.")
          .number("max_speed_m_per_s", &Options::max_speed, base::Range::positive(),
                  "A prediction of the motion that is faster than this is rejected.")
          .number("prediction_sigma_m", &Options::prediction_sigma, base::Range::positive(),
                  "Standard deviation of a predicted position. It matters where the walls leave a direction of the "
                  "motion unconstrained.")
          .number("prediction_sigma_deg", &Options::guess_angle_sigma, base::Range::positive(),
                  "Standard deviation of a predicted heading.")
          .number("prediction_sigma_per_m", &Options::prediction_sigma_per_m, zero_or_more,
                  "Additional standard deviation of the predicted position per metre moved, and of the predicted "
                  "heading per radian turned.")
          .number("point_sigma_m", &Options::point_sigma, base::Range::positive(),
                  "Smallest standard deviation that is assumed for the distance of a point from the wall it lies on. A "
                  "match may yield a larger one.")
          .number("position_noise_per_root_m", &Options::position_noise_per_root_m, zero_or_more,
                  "Standard deviation of the position after 1 m of distance travelled [m], in addition to that of the "
                  "scan matches; it grows with the square root of the distance.")
          .number("yaw_noise_per_root_m_deg", &Options::yaw_noise_per_root_m, zero_or_more,
                  "Standard deviation of the heading after 1 m of distance travelled, in addition to that of the scan "
                  "matches; it grows with the square root of the distance.")
          .number("yaw_noise_per_root_turn", &Options::yaw_noise_per_root_turn, zero_or_more,
                  "Standard deviation of the heading after 1 rad of rotation [rad], in addition to that of the scan "
                  "matches; it grows with the square root of the angle.");
  return table;
}

ScanOdometryPlugin::ScanOdometryPlugin(const ScanOdometryOptions& options, const matching::ScanTrackerOptions& tracking,
                                       const matching::ScanMatcherOptions& matching,
                                       const perception::LaserPointsOptions& points)
    : options_(options),
      tracking_(tracking),
      extractor_(points),
      near_(static_cast<float>(points.spacing + kAlsoNear)),
      tracker_(tracking, matching::makeMatcher(matching)),
      noise_(options.point_sigma) {}

bool ScanOdometryPlugin::isOurs(const mrpt::obs::CObservation2DRangeScan& scan) {
  if (label_ && scan.sensorLabel != *label_) return false;
  if (!options_.label.empty() && scan.sensorLabel != options_.label) return false;
  const double tilt = matching::tiltOf(scan.sensorPose);
  if (!(tilt <= matching::kLargestTilt)) {
    auto& tilted = tilted_[scan.sensorLabel];
    ++tilted.scans;
    tilted.tilt = std::max(tilted.tilt, tilt);
    return false;
  }
  label_ = scan.sensorLabel;
  return true;
}

ScanOdometryPlugin::Taken ScanOdometryPlugin::add(const mrpt::obs::CObservation::ConstPtr& observation) {
  const auto scan = std::dynamic_pointer_cast<const mrpt::obs::CObservation2DRangeScan>(observation);
  if (!scan) addOdometry(*observation);
  if (!scan || !isOurs(*scan)) return Taken::not_mine;
  if (!reached_ || scan->timestamp > *reached_) queue_.emplace(scan->timestamp, scan);
  return Taken::taken;
}

// Up to the last scan that odometry covers, too, because without odometry its match would start at a guess. Odometry
// that has ended is not waited for.
std::optional<base::Stamp> ScanOdometryPlugin::coveredUntil() const {
  constexpr double kAlive = 0.25;  // [s] odometry arrives at least four times a second
  const auto is_awaited = [](const Odometry& odometry, base::Stamp stamp) {
    const auto end = odometry.source.coveredUntil();
    const double offset = odometry.clock.offset();
    const auto wanted = stamp + base::durationFromSeconds(offset);
    return end && *end < wanted && base::secondsBetween(*end, wanted) < kAlive + std::max(0.0, offset);
  };
  for (auto scan = queue_.rbegin(); scan != queue_.rend(); ++scan) {
    const bool has_odometry = std::none_of(odometries_.begin(), odometries_.end(), [&](const Odometry& one) {
      return is_awaited(one, middleOf(*scan->second));
    });
    if (has_odometry) return scan->first;
  }
  return reached_;
}

// Processes one scan beyond `stamp`, so that the motion to a stamp between two scans is known.
void ScanOdometryPlugin::processUntil(base::Stamp stamp) {
  while (!queue_.empty() && (!reached_ || *reached_ < stamp)) {
    const auto next = queue_.extract(queue_.begin());
    reached_ = next.key();
    follow(next.mapped());
  }
  for (auto& odometry : odometries_) {
    followTurns(odometry);
    const auto kept = base::durationFromSeconds(motion::OdometryClock::kMost);
    odometry.source.forgetBefore(last_.value_or(stamp) - kept);
  }
}

base::Stamp ScanOdometryPlugin::middleOf(const mrpt::obs::CObservation2DRangeScan& scan) const {
  return scan.timestamp + base::durationFromSeconds(0.5 * options_.sweep);
}

matching::ScanWithNormals ScanOdometryPlugin::wallsOf(const mrpt::obs::CObservationPointCloud& cloud,
                                                      const mrpt::obs::CObservation2DRangeScan& scan,
                                                      const TPose2D& velocity) const {
  if (options_.sweep == 0) return matching::scanInBaseWithThings(cloud);
  return matching::scanInBaseWithThings(cloud, {scan.aperture, scan.rightToLeft, scaled(velocity, options_.sweep)});
}

void ScanOdometryPlugin::judge(Predictor& predictor, const TPose2D& motion) {
  constexpr double kMemory = 0.9;
  if (!predictor.motion) return;
  const TPose2D off = *predictor.motion - motion;
  const auto average = [](double& mean, double value) { mean = kMemory * mean + (1 - kMemory) * value; };
  average(predictor.error, sizeOf(off));
  average(predictor.position_error, mrpt::square(std::hypot(off.x, off.y)));
  average(predictor.angle_error, mrpt::square(mrpt::math::wrapToPi(off.phi)));
  predictor.is_judged = true;
}

namespace {
// Variance of a motion along walls that nothing measures: whatever the base did before, it may have braked or gone on.
// Its speed is correlated over kWhile, and so are the errors of the spans in it; a variance that is linear in time adds
// up to the right one over longer spans.
double blindVariance(double seconds) {
  constexpr double kUsualSpeed = 0.5, kWhile = 10;  // [m/s] [s]
  return mrpt::square(kUsualSpeed) * kWhile * seconds;
}

}  // namespace

void ScanOdometryPlugin::follow(const mrpt::obs::CObservation2DRangeScan::ConstPtr& observation) {
  const auto& scan = *observation;
  const double gap = sinceTheLast(scan);
  if (!last_ && is_stuck_ && haveSameRanges(scan, *matched_)) return leaveOut(scan);
  if (!last_) return restart(observation);
  const base::Stamp stamp = middleOf(scan);
  const double seconds = base::secondsBetween(*last_, stamp);
  const auto predictions = this->predictions(stamp);
  if (isFrozen(scan)) return leaveOut(scan);
  // Between stamps that nearly coincide, noise would look like speed.
  constexpr double kShortest = 0.02;  // [s]
  const bool is_long = seconds > kShortest;
  const TPose2D velocity =
      is_long && !predictions.empty() ? perSecond(predictions.front().guess.reference_from_scan, seconds) : velocity_;
  const auto derived = extractor_.extract(scan);
  const auto& cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*derived);
  auto walls = wallsOf(cloud, scan, velocity);
  const bool contradicts = contradictsWheels(walls, placeOf(scan), gap);
  auto tracked = tracker_.track(std::move(walls), placeOf(scan), predictions, base::secondsBetween(*begun_, stamp),
                                measuredMotion());
  constexpr double kSurely = 0.8;  // share of the points with a partner: then people stand around the base
  const bool is_carried = contradicts && !(tracked && tracked->is_determined && tracked->match.overlap >= kSurely);
  if (is_carried) tracked.reset();
  if (!tracked) {
    if (!is_carried && seconds <= options_.max_gap) return;
    if (is_carried) broken_.push_back(base::secondsBetween(*begun_, stamp) - gap);
    bridge(stamp, is_carried);
    return restart(observation);
  }
  addUpMotion(scan);
  matched_ = observation;
  moving_.points += tracked->moving.size();
  moving_.of_points += tracked->points;
  if (!tracked->moving.empty()) {
    const auto as_measured = matching::pointsInBase(cloud);
    std::vector<Eigen::Vector2f> moving;
    for (const std::size_t point : tracked->moving) moving.push_back(as_measured[point]);
    unusable_.emplace(scan.timestamp, std::move(moving));
  }
  const TPose2D& motion = tracked->match.reference_from_scan;
  const bool is_blind = tracked->match.degenerate && !isMeasuredByOdometry();
  auto guess = predictions[tracked->prediction].guess;
  if (is_blind)
    guess.information.topLeftCorner<2, 2>() =
        mrpt::square(noise_) / blindVariance(seconds) * Eigen::Matrix2d::Identity();
  (is_blind ? blind_seconds_ : seeing_seconds_) += seconds;
  auto measured = motionOf(*tracked, guess);
  measured.covariance.topLeftCorner<2, 2>() += contradictionOf(*tracked, stamp);
  if (is_first_ && is_long) {
    // The matched motion also covers the first half of the first sweep, from its stamp to its middle.
    const auto before = mrpt::poses::CPose2D(scaled(motion, 0.5 * options_.sweep / seconds));
    timeline_.insert(*last_ - base::durationFromSeconds(0.5 * options_.sweep), *last_,
                     {mrpt::poses::CPose3D(before), measured.covariance});
  }
  is_first_ = false;
  constexpr double kEven = 0.25;  // [s] in which the motion of a driving base hardly changes
  const auto* odometry = odometryLike(motion);
  if (odometry && seconds > kEven) {
    insertAlong(*odometry, stamp, measured);
  } else {
    timeline_.insert(*last_, stamp, measured);
  }
  constexpr double kMemory = 0.98;  // long, because the noise is a property of laser and place
  noise_ = kMemory * noise_ + (1 - kMemory) * std::max(options_.point_sigma, tracked->match.point_sigma);
  learn(*tracked, stamp);
  if (is_long) velocity_ = perSecond(motion, seconds);
  last_ = stamp;
}

// If a direction is unconstrained, the match agrees with any prediction and cannot judge it.
void ScanOdometryPlugin::learn(const matching::ScanTracker::Tracked& tracked, base::Stamp stamp) {
  const TPose2D& motion = tracked.match.reference_from_scan;
  for (auto& odometry : odometries_) {
    if (tracked.is_determined) odometry.clock.addMatch(*last_, stamp, motion.phi);
    constexpr double kOtherOffset = 0.03;  // [s] by which errors differ much
    if (std::abs(odometry.clock.offset() - odometry.learned_at) > kOtherOffset) {
      odometry.errors = {};
      odometry.learned_at = odometry.clock.offset();
    }
    if (!tracked.is_determined || !odometry.measured) {
      odometry.errors.interrupt();
    } else {
      odometry.errors.add(*odometry.predictor.motion, motion, 0.5 * tracked.covariance.topLeftCorner<2, 2>().trace(),
                          tracked.covariance(2, 2));
    }
    if (tracked.match.degenerate) continue;
    judge(odometry.predictor, motion);
    if (odometry.measured && tracked.is_determined) odometry.calibration.learn(*odometry.measured, motion);
  }
  if (!tracked.match.degenerate) judge(by_velocity_, motion);
}

// What covers both the scans and the odometry where they contradict each other, in the scan's frame [m2].
Eigen::Matrix2d ScanOdometryPlugin::contradictionOf(const matching::ScanTracker::Tracked& tracked, base::Stamp stamp) {
  heading_ += tracked.match.reference_from_scan.phi;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(heading_).toRotationMatrix();
  const Eigen::Matrix2d added = contradiction_.add(base::secondsBetween(*begun_, stamp), turn * tracked.difference,
                                                   turn * tracked.difference_covariance * turn.transpose());
  return turn.transpose() * added * turn;
}

// Starts again at this scan, unless it has too few points for the next scans to match with. The velocity is unknown.
void ScanOdometryPlugin::restart(const mrpt::obs::CObservation2DRangeScan::ConstPtr& observation) {
  const auto& scan = *observation;
  constexpr std::size_t kFewPoints = 10;
  last_.reset();
  is_stuck_ = false;
  contradiction_.interrupt();
  const auto derived = extractor_.extract(scan);
  const auto walls = wallsOf(dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*derived), scan, {});
  if (walls.size() < kFewPoints) return;
  velocity_ = {};
  matched_ = observation;
  last_ = middleOf(scan);
  if (!begun_) begun_ = last_;
  tracker_.restart(walls, placeOf(scan), base::secondsBetween(*begun_, *last_));
  is_first_ = true;
}

// The source that was more accurate recently comes first; without odometry, rest comes last.
std::vector<matching::MotionPrediction> ScanOdometryPlugin::predictions(base::Stamp stamp) {
  const double seconds = base::secondsBetween(*last_, stamp);
  constexpr double kSlack = 1;               // [m] for inexact stamps
  std::vector<const Odometry*> by_odometry;  // most accurate recently first
  for (auto& odometry : odometries_) {
    odometry.measured.reset();
    odometry.predictor.motion.reset();
    const auto measured = odometry.between(*last_, stamp);
    if (!measured) continue;
    const TPose2D motion = planar(measured->begin_from_end);
    if (std::hypot(motion.x, motion.y) > kSlack + options_.max_speed * seconds) continue;
    odometry.measured = motion;
    odometry.predictor.motion = odometry.calibration.applied(motion);
    by_odometry.push_back(&odometry);
  }
  const auto rank = [](const Odometry* one) { return std::tuple(!one->predictor.is_judged, one->predictor.error); };
  std::stable_sort(by_odometry.begin(), by_odometry.end(),
                   [&](const Odometry* a, const Odometry* b) { return rank(a) < rank(b); });
  by_velocity_.motion = scaled(velocity_, seconds);
  // The uncertainty of a prediction matters where walls constrain the match weakly, such as along a corridor. Constant
  // velocity is less certain than odometry, because the base may have braked or turned.
  constexpr double kAcceleration = 1, kTurnAcceleration = 1;            // [m/s2] [rad/s2]
  constexpr double kMostAcceleration = 10, kMostTurnAcceleration = 20;  // at most, of wheels that grip or slip
  constexpr double kStampError = 0.05;                                  // [s]
  constexpr double kMostPosition = 0.1, kMostAngle = 0.2;               // [m] [rad] errors of laser and wheels
  const double most_position = kMostPosition + kStampError * std::hypot(velocity_.x, velocity_.y) +
                               0.5 * kMostAcceleration * mrpt::square(seconds);
  const double most_angle =
      kMostAngle + kStampError * std::abs(velocity_.phi) + 0.5 * kMostTurnAcceleration * mrpt::square(seconds);
  const auto predicted = [&](const Predictor& predictor, double change, double turn_change) {
    const TPose2D& motion = *predictor.motion;
    const double position = std::hypot(
        options_.prediction_sigma + options_.prediction_sigma_per_m * std::hypot(motion.x, motion.y) + change,
        std::sqrt(predictor.position_error));
    const double angle =
        std::hypot(options_.guess_angle_sigma + options_.prediction_sigma_per_m * std::abs(motion.phi) + turn_change,
                   std::sqrt(predictor.angle_error));
    const Eigen::Vector3d sigmas(position, position, angle);
    return matching::MotionPrediction{
        {motion, Eigen::Matrix3d((noise_ * sigmas.cwiseInverse()).cwiseAbs2().asDiagonal())},
        position,
        angle,
        most_position,
        most_angle,
        false};
  };
  const double change = 0.5 * kAcceleration * mrpt::square(seconds),
               turn_change = 0.5 * kTurnAcceleration * mrpt::square(seconds);
  std::vector<matching::MotionPrediction> all;
  for (const auto* odometry : by_odometry) all.push_back(predicted(odometry->predictor, 0, 0));
  constexpr double kLongestSearch = 10, kUsualSpeed = 0.5, kUsualTurn = 0.5;  // [s] [m/s] [rad/s]
  // Across a gap neither constant velocity nor rest is a useful prediction: a match that starts there finds some wall
  // or other. The same holds just after a restart if odometry measures the motion.
  const bool is_unknown = is_first_ && !by_odometry.empty();
  if (seconds > options_.max_gap || is_unknown) {
    by_velocity_.motion.reset();
    if (all.empty() && seconds <= kLongestSearch) {
      const double reach = kUsualSpeed * seconds, turn = kUsualTurn * seconds;
      all.push_back({{}, reach, turn, options_.max_speed * seconds, M_PI, true});
    }
    return all;
  }
  const bool steady_is_better = by_odometry.empty() || by_velocity_.error < 0.5 * by_odometry.front()->predictor.error;
  all.insert(steady_is_better ? all.begin() : all.end(), predicted(by_velocity_, change, turn_change));
  if (all.size() == 1) all.push_back({{}, kAcceleration * seconds, kTurnAcceleration * seconds});
  return all;
}

// Variances are proportional to distance and rotation, so that those of consecutive spans add up. The variance of a
// match counts once per half the length of the local map, because all scans in between are matched with the same map
// and share its error. In directions that the walls leave unconstrained the covariance is that of the prediction.
mapper::RelativeMotion ScanOdometryPlugin::motionOf(const matching::ScanTracker::Tracked& tracked,
                                                    const matching::MatchGuess& guess) const {
  const auto& match = tracked.match;
  const TPose2D& motion = match.reference_from_scan;
  const double travel = std::hypot(motion.x, motion.y), turn = std::abs(mrpt::math::wrapToPi(motion.phi));
  const double share = std::min(1.0, 2 / static_cast<double>(tracking_.local_scans) *
                                             (travel / tracking_.local_distance + turn / tracking_.local_angle) +
                                         0.001);
  const double sigma = std::max(options_.point_sigma, match.point_sigma);
  Eigen::Matrix3d covariance =
      ((share * mrpt::square(sigma) * match.unit_covariance).inverse() + guess.information / mrpt::square(noise_))
          .inverse();
  const double position = mrpt::square(options_.position_noise_per_root_m) * travel;
  covariance += tracked.search_covariance;
  covariance.diagonal() += Eigen::Vector3d(
      position, position,
      mrpt::square(options_.yaw_noise_per_root_m) * travel + mrpt::square(options_.yaw_noise_per_root_turn) * turn);
  return planarMotion(motion, covariance);
}

}  // namespace omnimapper::plugins

// The other odometries of laser odometry, by which it predicts motions, and bridges spans that scans do not show.
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "BrokenMotion.h"
#include "PlanarMotion.h"
#include "ScanOdometryPlugin.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

std::optional<mapper::RelativeMotion> ScanOdometryPlugin::Odometry::between(base::Stamp begin, base::Stamp end) const {
  const auto offset = base::durationFromSeconds(clock.offset());
  return source.between(begin + offset, end + offset);
}

// Gives the clock of an odometry the turns that have arrived. Between rare readings the turns are not known: an offset
// would only choose how they are interpolated.
void ScanOdometryPlugin::followTurns(Odometry& odometry) {
  constexpr double kStep = motion::OdometryClock::kStep;
  constexpr double kRare = 0.25;  // [s] between readings
  const auto covered = odometry.source.coveredUntil();
  if (!covered) return;
  const double mean = base::secondsBetween(odometry.begun, *covered) / static_cast<double>(odometry.readings);
  if (mean > kRare) return;
  auto& clock = odometry.clock;
  if (!clock.end()) clock.addTurn(*covered, 0);
  for (;;) {
    const base::Stamp begin = *clock.end(), end = begin + base::durationFromSeconds(kStep);
    if (end > *covered) return;
    const auto motion = odometry.source.between(begin, end);
    if (!motion) return clock.addTurn(*covered, 0);  // begins again after a gap
    clock.addTurn(end, planar(motion->begin_from_end).phi);
  }
}

void ScanOdometryPlugin::addOdometry(const mrpt::obs::CObservation& observation) {
  const std::string& label = observation.sensorLabel;
  if (!options_.odometry_label.empty() && label != options_.odometry_label) return;
  for (auto& known : odometries_) {
    if (known.label != label) continue;
    known.readings += known.source.add(observation) == motion::WheelOdometry::Taken::taken;
    return;
  }
  motion::WheelOdometryOptions odometry;
  odometry.label = label;
  motion::WheelOdometry source(odometry);
  if (source.add(observation) != motion::WheelOdometry::Taken::not_mine)
    odometries_.push_back({label, std::move(source), 1, observation.timestamp, {}, {}, {}, {}, 0, {}, {}});
}

// Whether an odometry measured the motion to the current scan.
bool ScanOdometryPlugin::isMeasuredByOdometry() const {
  return std::any_of(odometries_.begin(), odometries_.end(),
                     [](const Odometry& odometry) { return odometry.measured.has_value(); });
}

// Time since the scan before [s]; infinite for the first one.
double ScanOdometryPlugin::sinceTheLast(const mrpt::obs::CObservation2DRangeScan& scan) {
  constexpr double kKept = 0.95;
  const auto before = std::exchange(pace_.last, scan.timestamp);
  if (!before) return std::numeric_limits<double>::infinity();
  const double gap = base::secondsBetween(*before, scan.timestamp);
  constexpr double kLongest = 3;  // of the usual: a pause does not make pauses usual at once
  pace_.seconds =
      pace_.seconds == 0 ? gap : kKept * pace_.seconds + (1 - kKept) * std::min(gap, kLongest * pace_.seconds);
  return gap;
}

// Covers the span up to a scan that matches nothing with the motion that odometry measured, if any did. Its covariance
// is that of the errors that this odometry had where walls determined the motion, but not less than the usual one; if
// the base was carried, odometry measured nothing.
void ScanOdometryPlugin::bridge(base::Stamp stamp, bool is_carried) {
  const auto* best = mostAccurate();
  if (!best) {
    if (gaps_.count++ == 0) gaps_.first = base::secondsBetween(*begun_, stamp);
    return;
  }
  const auto usual = best->between(*last_, stamp);
  if (!usual) return;
  auto covariance = best->errors.covarianceOf(*best->measured);
  const auto& least = usual->covariance;
  covariance.diagonal() = covariance.diagonal().cwiseMax(Eigen::Vector3d(least(0, 0), least(1, 1), least(5, 5)));
  if (is_carried) covariance.diagonal() += Eigen::Vector3d(kBrokenPosition, kBrokenPosition, kBrokenYaw).cwiseAbs2();
  insertAlong(*best, stamp, planarMotion(*best->predictor.motion, covariance));
}

// Whether, after an unusual gap, the beams of a scan contradict what was seen before it wherever the wheels may have
// brought the base. That they show something else is no contradiction: the base may have driven there. `gap`: [s] since
// the scan before.
bool ScanOdometryPlugin::contradictsWheels(const matching::ScanWithNormals& walls, const Eigen::Vector2f& sensor,
                                           double gap) {
  constexpr double kLong = 1.5, kUnusual = 4;                    // [s], and times the usual
  constexpr double kSigmas = 3, kLeast = 0.3, kLeastTurn = 0.1;  // [m] [rad] of what the wheels may be off by
  constexpr double kMostContradict = 0.2;                        // share of the beams; people explain less
  const auto* best = mostAccurate();
  if (!best || gap < kLong || gap < kUnusual * pace_.seconds) return false;
  const Eigen::Vector3d sigmas = best->errors.covarianceOf(*best->measured).diagonal().cwiseSqrt();
  const auto fit = tracker_.fitAround(walls, sensor, *best->predictor.motion, kLeast + kSigmas * sigmas.x(),
                                      kLeastTurn + kSigmas * sigmas.z());
  return fit && fit->contradicting > kMostContradict;
}

// The odometry that measured the motion to the current scan and was most accurate recently; null if none measured it.
const ScanOdometryPlugin::Odometry* ScanOdometryPlugin::mostAccurate() const {
  const Odometry* best = nullptr;
  for (const auto& odometry : odometries_) {
    if (!odometry.measured) continue;
    const auto rank = [](const Odometry& one) { return std::tuple(!one.predictor.is_judged, one.predictor.error); };
    if (!best || rank(odometry) < rank(*best)) best = &odometry;
  }
  return best;
}

std::optional<matching::MeasuredMotion> ScanOdometryPlugin::measuredMotion() const {
  const auto* best = mostAccurate();
  if (!best) return std::nullopt;
  return matching::MeasuredMotion{*best->predictor.motion, best->errors.covarianceOf(*best->measured)};
}

// The odometry whose motion is closest to a matched one; null if none is close.
const ScanOdometryPlugin::Odometry* ScanOdometryPlugin::odometryLike(const TPose2D& motion) const {
  constexpr double kLeast = 0.1, kShare = 0.2;  // [m], and of the motion: wheels that slip more do not show its path
  const Odometry* nearest = nullptr;
  double least = kLeast + kShare * sizeOf(motion);
  for (const auto& odometry : odometries_) {
    if (!odometry.measured) continue;
    const double off = sizeOf(*odometry.predictor.motion - motion);
    if (off >= least) continue;
    least = off;
    nearest = &odometry;
  }
  return nearest;
}

// Across missing scans the motion is not uniform, and other sensors may have measured meanwhile. The path is therefore
// that of the wheels, with a correction that grows linearly in time so that it ends at the matched pose.
void ScanOdometryPlugin::insertAlong(const Odometry& odometry, base::Stamp end,
                                     const mapper::RelativeMotion& measured) {
  constexpr double kStep = 0.1;  // [s] in which a driving base hardly turns
  const base::Stamp begin = *last_;
  const double seconds = base::secondsBetween(begin, end);
  const int steps = static_cast<int>(std::ceil(seconds / kStep));
  const TPose2D correction = planar(measured.begin_from_end) - *odometry.predictor.motion;
  TPose2D reached{};
  base::Stamp from = begin;
  for (int step = 1; step <= steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    const base::Stamp to = step == steps ? end : begin + base::durationFromSeconds(share * seconds);
    const auto driven = odometry.between(begin, to);
    if (!driven) continue;
    const TPose2D pose = odometry.calibration.applied(planar(driven->begin_from_end)) + scaled(correction, share);
    const double part = base::secondsBetween(from, to) / seconds;
    timeline_.insert(from, to,
                     {mrpt::poses::CPose3D(mrpt::poses::CPose2D(pose - reached)), part * measured.covariance});
    reached = pose;
    from = to;
  }
}

}  // namespace omnimapper::plugins

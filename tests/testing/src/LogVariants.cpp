#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/testing/LogVariants.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace omnimapper::testing {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::poses::CPose2D;
using obs::CObservationRelativeMotion;

namespace {

using Log = std::vector<CObservation::Ptr>;
using Wheels = std::function<CPose2D(const CPose2D& motion)>;

template <class Class>
std::shared_ptr<Class> copyOf(const CObservation::Ptr& observation) {
  if (!dynamic_cast<const Class*>(observation.get())) return nullptr;
  return std::dynamic_pointer_cast<Class>(observation->duplicateGetSmartPtr());
}

bool isOfWheels(const CObservation& observation) {
  return dynamic_cast<const CObservationOdometry*>(&observation) ||
         dynamic_cast<const CObservationRelativeMotion*>(&observation);
}

Log reversed(const Log& log) {
  Log turned;
  for (auto next = log.rbegin(); next != log.rend(); ++next) {
    auto copy = std::dynamic_pointer_cast<CObservation>((*next)->duplicateGetSmartPtr());
    copy->timestamp = reversedStamp(log, copy->timestamp);
    if (auto* motion = dynamic_cast<CObservationRelativeMotion*>(copy.get())) {
      const base::Stamp end = reversedStamp(log, motion->begin);
      motion->begin = motion->timestamp;
      motion->timestamp = end;
      const geometry::Matrix6d to_start = geometry::adjoint(geometry::fromMrpt(motion->begin_from_end));
      motion->covariance = to_start * motion->covariance * to_start.transpose();
      motion->begin_from_end = -motion->begin_from_end;
    } else if (auto* odometry = dynamic_cast<CObservationOdometry*>(copy.get())) {
      odometry->hasVelocities = odometry->hasEncodersInfo = false;
    }
    turned.push_back(std::move(copy));
  }
  // A motion is handed out at its end, which was its start.
  std::stable_sort(turned.begin(), turned.end(),
                   [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return turned;
}

Log thinned(const Log& log, std::size_t every) {
  Log thin;
  std::map<std::string, std::size_t> seen;
  for (const auto& observation : log) {
    const bool is_scan = dynamic_cast<const CObservation2DRangeScan*>(observation.get()) != nullptr;
    if (!is_scan || seen[observation->sensorLabel]++ % every == 0) thin.push_back(observation);
  }
  return thin;
}

// Each odometry on its own, from where it began.
Log withWheels(const Log& log, const Wheels& measured) {
  struct Pose {
    CPose2D last, changed;
  };
  std::map<std::string, Pose> poses;
  Log changed;
  for (const auto& observation : log) {
    if (auto odometry = copyOf<CObservationOdometry>(observation)) {
      auto [pose, is_first] = poses.try_emplace(odometry->sensorLabel, Pose{odometry->odometry, odometry->odometry});
      if (!is_first) pose->second.changed = pose->second.changed + measured(odometry->odometry - pose->second.last);
      pose->second.last = odometry->odometry;
      odometry->odometry = pose->second.changed;
      changed.push_back(std::move(odometry));
    } else if (auto motion = copyOf<CObservationRelativeMotion>(observation)) {
      motion->begin_from_end = mrpt::poses::CPose3D(measured(CPose2D(motion->begin_from_end)));
      changed.push_back(std::move(motion));
    } else {
      changed.push_back(observation);
    }
  }
  return changed;
}

CObservation::Ptr narrowed(const CObservation::Ptr& observation) {
  const auto scan = copyOf<CObservation2DRangeScan>(observation);
  if (!scan || scan->getScanSize() < 6) return observation;
  const auto& whole = dynamic_cast<const CObservation2DRangeScan&>(*observation);
  const std::size_t size = whole.getScanSize(), cut = size / 6, left = size - 2 * cut;
  scan->resizeScan(left);
  for (std::size_t i = 0; i < left; ++i) {
    scan->setScanRange(i, whole.getScanRange(i + cut));
    scan->setScanRangeValidity(i, whole.getScanRangeValidity(i + cut));
  }
  scan->aperture *= static_cast<float>(left - 1) / static_cast<float>(size - 1);
  return scan;
}

Log fromTheMiddle(const Log& log) {
  const base::Stamp middle = log.front()->timestamp + (log.back()->timestamp - log.front()->timestamp) / 2;
  Log rest;
  std::copy_if(log.begin(), log.end(), std::back_inserter(rest),
               [&](const auto& observation) { return observation->timestamp >= middle; });
  return rest;
}

}  // namespace

const std::vector<LogVariant>& allLogVariants() {
  static const std::vector<LogVariant> all{
      LogVariant::as_it_is,          LogVariant::reversed,       LogVariant::every_second_scan,
      LogVariant::every_fourth_scan, LogVariant::without_wheels, LogVariant::long_wheels,
      LogVariant::turning_wheels,    LogVariant::narrow_laser,   LogVariant::from_the_middle};
  return all;
}

std::string nameOf(LogVariant variant) {
  switch (variant) {
    case LogVariant::as_it_is:
      return "as it is";
    case LogVariant::reversed:
      return "reversed";
    case LogVariant::every_second_scan:
      return "every second scan";
    case LogVariant::every_fourth_scan:
      return "every fourth scan";
    case LogVariant::without_wheels:
      return "without wheels";
    case LogVariant::long_wheels:
      return "wheels 5 % too long";
    case LogVariant::turning_wheels:
      return "wheels turn 2 deg/m";
    case LogVariant::narrow_laser:
      return "without outer beams";
    case LogVariant::from_the_middle:
      return "second half";
  }
  throw base::Error(base::ExitCode::internal, "no such variant of a log");
}

base::Stamp reversedStamp(const std::vector<CObservation::Ptr>& log, base::Stamp stamp) {
  return log.front()->timestamp + (log.back()->timestamp - stamp);
}

std::vector<CObservation::Ptr> variantOf(const std::vector<CObservation::Ptr>& log, LogVariant variant) {
  constexpr double kTurnPerMetre = 2 * geometry::kPi / 180;
  Log changed;
  switch (variant) {
    case LogVariant::as_it_is:
      return log;
    case LogVariant::reversed:
      return reversed(log);
    case LogVariant::every_second_scan:
      return thinned(log, 2);
    case LogVariant::every_fourth_scan:
      return thinned(log, 4);
    case LogVariant::without_wheels:
      std::copy_if(log.begin(), log.end(), std::back_inserter(changed),
                   [](const auto& observation) { return !isOfWheels(*observation); });
      return changed;
    case LogVariant::long_wheels:
      return withWheels(
          log, [](const CPose2D& motion) { return CPose2D(1.05 * motion.x(), 1.05 * motion.y(), motion.phi()); });
    case LogVariant::turning_wheels:
      return withWheels(log, [](const CPose2D& motion) {
        return CPose2D(motion.x(), motion.y(), motion.phi() + kTurnPerMetre * std::hypot(motion.x(), motion.y()));
      });
    case LogVariant::narrow_laser:
      std::transform(log.begin(), log.end(), std::back_inserter(changed), narrowed);
      return changed;
    case LogVariant::from_the_middle:
      return fromTheMiddle(log);
  }
  throw base::Error(base::ExitCode::internal, "no such variant of a log");
}

}  // namespace omnimapper::testing

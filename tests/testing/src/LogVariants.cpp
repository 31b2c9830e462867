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
using Wheels = std::function<CPose2D(const CPose2D& motion, base::Stamp begin, base::Stamp end)>;

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
  // A motion has the stamp of its end, which is the start of the original motion, so the order changes.
  std::stable_sort(turned.begin(), turned.end(),
                   [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return turned;
}

Log thinned(const Log& log, std::size_t every) {
  Log thin;
  std::map<std::string, std::size_t> scans;
  for (const auto& observation : log) {
    const bool is_scan = dynamic_cast<const CObservation2DRangeScan*>(observation.get()) != nullptr;
    if (!is_scan || scans[observation->sensorLabel]++ % every == 0) thin.push_back(observation);
  }
  return thin;
}

// Replaces the motions of each odometry by `measured`, beginning at its first pose.
Log withWheels(const Log& log, const Wheels& measured) {
  struct Pose {
    CPose2D last, changed;
    base::Stamp stamp;
  };
  std::map<std::string, Pose> poses;
  Log changed;
  for (const auto& observation : log) {
    if (auto odometry = copyOf<CObservationOdometry>(observation)) {
      auto [pose, is_first] =
          poses.try_emplace(odometry->sensorLabel, Pose{odometry->odometry, odometry->odometry, odometry->timestamp});
      auto& [last, moved, stamp] = pose->second;
      if (!is_first) moved = moved + measured(odometry->odometry - last, stamp, odometry->timestamp);
      last = odometry->odometry;
      stamp = odometry->timestamp;
      odometry->odometry = moved;
      changed.push_back(std::move(odometry));
    } else if (auto motion = copyOf<CObservationRelativeMotion>(observation)) {
      motion->begin_from_end =
          mrpt::poses::CPose3D(measured(CPose2D(motion->begin_from_end), motion->begin, motion->timestamp));
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

// Distance travelled [m] by the first odometry of the log, at its stamps.
std::vector<std::pair<base::Stamp, double>> travelOf(const Log& log) {
  std::vector<std::pair<base::Stamp, double>> travel;
  std::string label;
  CPose2D last;
  for (const auto& observation : log) {
    if (!isOfWheels(*observation) || (!label.empty() && observation->sensorLabel != label)) continue;
    CPose2D step;
    if (const auto* motion = dynamic_cast<const CObservationRelativeMotion*>(observation.get())) {
      step = CPose2D(motion->begin_from_end);
    } else {
      const CPose2D& pose = dynamic_cast<const CObservationOdometry&>(*observation).odometry;
      if (!travel.empty()) step = pose - last;
      last = pose;
    }
    label = observation->sensorLabel;
    travel.emplace_back(observation->timestamp, step.norm() + (travel.empty() ? 0 : travel.back().second));
  }
  return travel;
}

Log withSlip(const Log& log) {
  constexpr double kTurn = 40 * geometry::kPi / 180;
  const auto lasting = base::durationFromSeconds(5);
  const auto third = (log.back()->timestamp - log.front()->timestamp) / 3;
  const auto travel = travelOf(log);
  base::Stamp begin = log.front()->timestamp + third;
  double farthest = -1;
  for (std::size_t i = 0, end = 0; i < travel.size(); ++i) {
    while (end + 1 < travel.size() && travel[end + 1].first <= travel[i].first + lasting) ++end;
    const bool is_within =
        travel[i].first >= log.front()->timestamp + third && travel[i].first + lasting <= log.back()->timestamp - third;
    const double distance = travel[end].second - travel[i].second;
    if (!is_within || distance <= farthest) continue;
    farthest = distance;
    begin = travel[i].first;
  }
  const auto shareOf = [&](base::Stamp from, base::Stamp to) {
    return std::max(0.0, base::secondsBetween(std::max(from, begin), std::min(to, begin + lasting))) /
           base::secondsBetween(begin, begin + lasting);
  };
  Log slipping = withWheels(log, [&](const CPose2D& motion, base::Stamp from, base::Stamp to) {
    return CPose2D(motion.x(), motion.y(), motion.phi() + kTurn * shareOf(from, to));
  });
  slipping.erase(std::remove_if(slipping.begin(), slipping.end(),
                                [&](const auto& observation) {
                                  return dynamic_cast<const CObservation2DRangeScan*>(observation.get()) &&
                                         observation->timestamp > begin && observation->timestamp < begin + lasting;
                                }),
                 slipping.end());
  return slipping;
}

}  // namespace

const std::vector<LogVariant>& allLogVariants() {
  static const std::vector<LogVariant> all{LogVariant::as_it_is,          LogVariant::reversed,
                                           LogVariant::every_second_scan, LogVariant::every_fourth_scan,
                                           LogVariant::without_wheels,    LogVariant::long_wheels,
                                           LogVariant::turning_wheels,    LogVariant::narrow_laser,
                                           LogVariant::from_the_middle,   LogVariant::unseen_slip};
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
    case LogVariant::unseen_slip:
      return "slip that no scan sees";
  }
  throw base::Error(base::ExitCode::internal, "no such variant of a log");
}

std::vector<CObservation::Ptr> carried(const Log& log, base::Stamp from, base::Stamp to, double gap) {
  const auto later = from + base::durationFromSeconds(gap) - to;
  struct Wheels {
    CPose2D before, after;  // last pose before the gap, first one after it
    bool is_after = false;
  };
  std::map<std::string, Wheels> wheels;
  Log changed;
  for (const auto& observation : log) {
    const auto* odometry = dynamic_cast<const CObservationOdometry*>(observation.get());
    if (observation->timestamp <= from) {
      if (odometry) wheels[observation->sensorLabel].before = odometry->odometry;
      changed.push_back(observation);
    }
    if (observation->timestamp < to || observation->timestamp <= from) continue;
    auto copy = std::dynamic_pointer_cast<CObservation>(observation->duplicateGetSmartPtr());
    copy->timestamp += later;
    if (auto* moved = dynamic_cast<CObservationOdometry*>(copy.get())) {
      Wheels& wheel = wheels[observation->sensorLabel];
      if (!wheel.is_after) wheel.after = moved->odometry;
      wheel.is_after = true;
      moved->odometry = wheel.before + (moved->odometry - wheel.after);
    } else if (auto* motion = dynamic_cast<CObservationRelativeMotion*>(copy.get())) {
      if (motion->begin < to) continue;
      motion->begin += later;
    }
    changed.push_back(std::move(copy));
  }
  return changed;
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
      return withWheels(log, [](const CPose2D& motion, base::Stamp, base::Stamp) {
        return CPose2D(1.05 * motion.x(), 1.05 * motion.y(), motion.phi());
      });
    case LogVariant::turning_wheels:
      return withWheels(log, [](const CPose2D& motion, base::Stamp, base::Stamp) {
        return CPose2D(motion.x(), motion.y(), motion.phi() + kTurnPerMetre * std::hypot(motion.x(), motion.y()));
      });
    case LogVariant::narrow_laser:
      std::transform(log.begin(), log.end(), std::back_inserter(changed), narrowed);
      return changed;
    case LogVariant::from_the_middle:
      return fromTheMiddle(log);
    case LogVariant::unseen_slip:
      return withSlip(log);
  }
  throw base::Error(base::ExitCode::internal, "no such variant of a log");
}

}  // namespace omnimapper::testing

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/check/gatherFacts.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "LevelStatistics.h"
#include "OdometryStatistics.h"
#include "PoseStatistics.h"
#include "ScanPairs.h"
#include "ScanStatistics.h"
#include "StampStatistics.h"
#include "compareMotions.h"

namespace omnimapper::check {

namespace {

using mrpt::obs::CObservation2DRangeScan;

// Iterator behind the first `count` elements.
template <class Map>
typename Map::const_iterator beginningOf(const Map& map, std::size_t count) {
  return std::next(map.begin(), static_cast<std::ptrdiff_t>(std::min(count, map.size())));
}

// Collects all statistics while the log is read.
class Gatherer {
 public:
  void add(const mrpt::obs::CObservation::Ptr& observation) {
    const auto stamp = observation->timestamp;
    const std::string& label = observation->sensorLabel;
    clock_.add(stamp);
    stamps_[{label, observation->GetRuntimeClass()->className}].add(stamp, clock_);
    if (OdometryStatistics::isOdometry(*observation)) odometry_[label].add(*observation);
    level_.add(*observation);
    if (const auto pose = std::dynamic_pointer_cast<const mrpt::obs::CObservationRobotPose>(observation)) {
      poses_[label].add(*pose);
    }
    if (const auto image = std::dynamic_pointer_cast<const mrpt::obs::CObservation3DRangeScan>(observation)) {
      const bool is_calibrated = image->cameraParams.fx() > 0 && image->cameraParams.fy() > 0;
      if (image->hasRangeImage && !is_calibrated) {
        auto& left_out = uncalibrated_[{label, "the camera is not calibrated: its focal length is not positive"}];
        if (left_out.observations++ == 0) left_out.first_stamp = stamp;
      }
    }
    if (const auto scan = std::dynamic_pointer_cast<const CObservation2DRangeScan>(observation)) {
      auto& laser = lasers_[label];
      laser.statistics.add(*scan);
      laser.pairs.add(scan);
      if (base::isValid(stamp)) laser.stamps.push_back(stamp);
    }
  }

  LogFacts facts() const {
    LogFacts facts;
    facts.unusable = uncalibrated_;
    for (const auto& [sensor, statistics] : stamps_) facts.sensors[sensor] = stampFacts(statistics);
    for (const auto& [label, statistics] : odometry_) facts.odometry[label] = statistics.facts();
    for (const auto& [label, statistics] : poses_) facts.poses[label] = statistics.facts();
    facts.levels = level_.facts(!odometry_.empty());
    // No robot has more lasers or odometries; comparing a log with more labels would take minutes.
    constexpr std::size_t kMost = 10;
    const auto compared = beginningOf(odometry_, kMost);
    for (auto a = odometry_.begin(); a != compared; ++a) {
      for (auto b = std::next(a); b != compared; ++b) {
        facts.odometry_pairs.push_back(compareOdometries(a->first, a->second, b->first, b->second));
      }
    }
    for (const auto& [label, laser] : lasers_) {
      facts.scans[label] = laser.statistics.facts();
      if (facts.scans.size() > kMost) continue;
      for (auto odometry = odometry_.begin(); odometry != compared; ++odometry) {
        facts.motions.push_back(motionOf(label, laser, odometry->first, &odometry->second));
        facts.covered[{label, odometry->first}] = coveredShare(laser, odometry->second);
      }
      if (odometry_.empty()) facts.motions.push_back(motionOf(label, laser, "", nullptr));
    }
    return facts;
  }

 private:
  struct Laser {
    ScanStatistics statistics;
    ScanPairs pairs;
    std::vector<base::Stamp> stamps;
  };

  StampFacts stampFacts(const StampStatistics& statistics) const {
    StampFacts facts = statistics.facts();
    for (const auto& [begin, end] : statistics.gaps()) {
      if (isRest(begin, end)) {
        ++facts.rests;
      } else {
        facts.longest_drive = std::max(facts.longest_drive, base::secondsBetween(begin, end));
      }
    }
    return facts;
  }

  bool isRest(base::Stamp begin, base::Stamp end) const {
    constexpr double kStayed = 1.5, kFaced = 1;  // [m] [rad]
    bool is_measured = false;
    for (const auto& [label, odometry] : odometry_) {
      const auto motion = odometry.between(begin, end);
      if (motion && (motion->norm() > kStayed || std::abs(motion->phi()) > kFaced)) return false;
      is_measured = is_measured || motion;
    }
    return is_measured;
  }

  static MotionFacts motionOf(const std::string& label, const Laser& laser, const std::string& odometry,
                              const OdometryStatistics* statistics) {
    const auto between = [&](base::Stamp begin, base::Stamp end) {
      return statistics ? statistics->between(begin, end) : std::nullopt;
    };
    auto facts = compareMotions(laser.pairs.pairs(), laser.statistics.facts().aperture, between);
    facts.laser = label;
    facts.odometry = odometry;
    facts.tried = laser.pairs.pairs().size();
    return facts;
  }

  static double coveredShare(const Laser& laser, const OdometryStatistics& odometry) {
    if (laser.stamps.empty()) return 0;
    const auto covered = std::count_if(laser.stamps.begin(), laser.stamps.end(),
                                       [&](base::Stamp stamp) { return odometry.between(stamp, stamp).has_value(); });
    return static_cast<double>(covered) / static_cast<double>(laser.stamps.size());
  }

  std::map<std::pair<std::string, std::string>, StampStatistics> stamps_;
  std::map<std::string, OdometryStatistics> odometry_;
  std::map<std::string, PoseStatistics> poses_;
  LevelStatistics level_;
  std::map<std::string, Laser> lasers_;
  StreamClock clock_;
  std::map<std::pair<std::string, std::string>, source::LeftOut> uncalibrated_;  // as LogFacts::unusable
};

}  // namespace

LogFacts gatherFacts(source::ObservationSource& log, const mapper::SensorPoses& sensor_poses,
                     const std::function<bool()>& stop, base::Progress* progress) {
  Gatherer gatherer;
  while (!stop()) {
    const auto observation = log.next();
    if (!observation) break;
    gatherer.add(sensor_poses.applied(observation));
    if (progress) progress->report(log.progress(), "reading the log");
  }
  auto facts = gatherer.facts();
  auto report = log.report();
  facts.unusable.merge(report.unusable);
  facts.missing_images = report.missing_images;
  facts.first_missing_image = report.first_missing_image;
  return facts;
}

}  // namespace omnimapper::check

#include "PlayedLog.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/source/RawlogSource.h>

#include <algorithm>

namespace omnimapper::players {

PlayedLog PlayedLog::of(const std::vector<mrpt::obs::CObservation::Ptr>& observations) {
  PlayedLog log;
  std::vector<OdometryReading> motions;
  mrpt::poses::CPose2D odom_from_base;
  for (const auto& observation : observations) {
    const auto stamp = observation->timestamp;
    if (auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation)) {
      auto& scans = log.lasers[scan->sensorLabel];
      if (scans.empty() || stamp > scans.back()->timestamp) scans.push_back(scan);
    } else if (const auto wheels = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation)) {
      if (!log.odometry.empty() && stamp <= log.odometry.back().log) continue;
      log.odometry.push_back({stamp, wheels->odometry, std::nullopt});
      if (wheels->hasVelocities) log.odometry.back().velocity = wheels->velocityLocal;
    } else if (const auto motion = std::dynamic_pointer_cast<obs::CObservationRelativeMotion>(observation)) {
      odom_from_base = odom_from_base + mrpt::poses::CPose2D(motion->begin_from_end);
      if (motions.empty() || stamp > motions.back().log) motions.push_back({stamp, odom_from_base, std::nullopt});
    }
  }
  if (log.odometry.empty()) log.odometry = motions;
  return log;
}

PlayedLog PlayedLog::read(const std::string& rawlog) {
  source::RawlogSource source(rawlog);
  std::vector<mrpt::obs::CObservation::Ptr> observations;
  while (auto observation = source.next()) observations.push_back(std::move(observation));
  return of(observations);
}

base::Stamp PlayedLog::start() const {
  std::vector<base::Stamp> first;
  for (const auto& [label, scans] : lasers) first.push_back(scans.front()->timestamp);
  if (!odometry.empty()) first.push_back(odometry.front().log);
  if (first.empty())
    throw base::Error(base::ExitCode::unreadable_input, "The log has neither scans of a laser nor odometry.");
  return *std::min_element(first.begin(), first.end());
}

}  // namespace omnimapper::players

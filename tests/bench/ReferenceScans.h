#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/matching/Relocalizer.h>
#include <omnimapper/source/openLogs.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace omnimapper::bench {

constexpr double kLongest = 25;  // [m] longer beams are cut to this length and only show free space
constexpr double kNoEcho = 80;   // [m] a SICK reports a missing echo, near or far, as a range from here on

/// The scans of a log that have a pose of the base in `truth`, with the pose of the sensor. A scan is left out if it is
/// less than `travel` [m] and less than `turn` [rad] away from the last one that was kept.
inline std::vector<matching::MapScan> scansOf(source::ObservationSource& log, const eval::Trajectory& truth,
                                              double travel = 0, double turn = 0) {
  std::vector<matching::MapScan> scans;
  while (const auto observation = log.next()) {
    const auto* laser = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(observation.get());
    if (!laser) continue;
    const auto index = eval::nearestPose(truth, laser->timestamp, base::durationFromSeconds(2e-4));
    if (!index) continue;
    const auto& pose = truth[*index].world_from_body;
    const Eigen::Matrix3d turned = pose.rotation.toRotationMatrix();
    matching::MapScan scan;
    scan.map_from_sensor =
        mrpt::math::TPose2D(pose.translation.x(), pose.translation.y(), std::atan2(turned(1, 0), turned(0, 0))) +
        mrpt::math::TPose2D(laser->sensorPose.asTPose());
    if (!scans.empty()) {
      const auto moved = scan.map_from_sensor - scans.back().map_from_sensor;
      if (std::hypot(moved.x, moved.y) < travel && std::abs(moved.phi) < turn) continue;
    }
    for (std::size_t i = 0; i < laser->getScanSize(); ++i) {
      const double range = laser->getScanRange(i), length = std::min(range, kLongest);
      const double angle = (static_cast<double>(i) / (laser->getScanSize() - 1) - 0.5) * laser->aperture;
      if (!(range > 0.02) || range >= kNoEcho) continue;
      auto& beams = range < kLongest && laser->getScanRangeValidity(i) ? scan.scan.hits : scan.scan.misses;
      beams.emplace_back(length * std::cos(angle), length * std::sin(angle));
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

/// The scans of FOLDER/NAME.clf.bz2 that have a pose in FOLDER/NAME.reference.tum.
inline std::vector<matching::MapScan> referenceScans(const std::string& folder, const std::string& name) {
  const auto log = source::openLogs({folder + "/" + name + ".clf.bz2"}, {});
  return scansOf(*log, eval::readTum(folder + "/" + name + ".reference.tum"));
}

}  // namespace omnimapper::bench

#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/matching/Relocaliser.h>
#include <omnimapper/source/CarmenLog.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace omnimapper::bench {

constexpr double kLongest = 25;  // [m] of a beam: what lies further away is only known to be there
constexpr double kNoEcho = 80;   // [m] from here on a SICK tells that it has no echo, near or far

/// The scans of FOLDER/NAME.clf.bz2 that have a pose in FOLDER/NAME.reference.tum, with that pose.
inline std::vector<matching::MapScan> referenceScans(const std::string& folder, const std::string& name) {
  const auto truth = eval::readTum(folder + "/" + name + ".reference.tum");
  source::CarmenLog stream(folder + "/" + name + ".clf.bz2");
  std::vector<matching::MapScan> scans;
  while (const auto observation = stream.next()) {
    const auto* laser = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(observation.get());
    if (!laser) continue;
    const auto index = eval::nearestPose(truth, laser->timestamp, base::durationFromSeconds(2e-4));
    if (!index) continue;
    const auto& pose = truth[*index].world_from_body;
    const Eigen::Matrix3d turned = pose.rotation.toRotationMatrix();
    matching::MapScan scan;
    scan.map_from_sensor = {pose.translation.x(), pose.translation.y(), std::atan2(turned(1, 0), turned(0, 0))};
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

}  // namespace omnimapper::bench

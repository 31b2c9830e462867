#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/map/Map.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

/// Calls `use(scan)` for each 2D scan of a key frame.
template <class Use>
void forEachScan(const map::KeyFrame& frame, const Use& use) {
  for (const auto& observation : frame.observations) {
    const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(observation.get());
    if (scan) use(*scan);
  }
}

/// Where the beams of a scan end, in the map [m].
class BeamEnds {
 public:
  BeamEnds(const mrpt::obs::CObservation2DRangeScan& scan, const mrpt::poses::CPose3D& map_from_base)
      : scan_(scan), map_from_sensor_(map_from_base + scan.sensorPose) {
    const double sign = scan.rightToLeft ? 1 : -1;
    first_ = size() > 1 ? -0.5 * sign * scan.aperture : 0;
    step_ = size() > 1 ? sign * scan.aperture / static_cast<double>(size() - 1) : 0;
  }

  std::size_t size() const { return scan_.getScanSize(); }
  mrpt::math::TPoint3D origin() const { return map_from_sensor_.translation(); }
  bool valid(std::size_t beam) const {
    const float range = scan_.getScanRange(beam);
    return scan_.getScanRangeValidity(beam) && std::isfinite(range) && range > 0;
  }
  /// Whether something was there: many sensors tell their own limit when nothing came back.
  bool hits(std::size_t beam) const { return valid(beam) && scan_.getScanRange(beam) < scan_.maxRange; }
  /// End of the beam, cut at `max_range` [m].
  mrpt::math::TPoint3D at(std::size_t beam, double max_range) const {
    const double range = std::min<double>(scan_.getScanRange(beam), max_range);
    const double angle = first_ + step_ * static_cast<double>(beam);
    return map_from_sensor_.composePoint({range * std::cos(angle), range * std::sin(angle), 0});
  }

 private:
  const mrpt::obs::CObservation2DRangeScan& scan_;
  mrpt::poses::CPose3D map_from_sensor_;
  double first_, step_;  // [rad] angle of the first beam, and between beams
};

}  // namespace omnimapper::plugins

#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/geometry/FloorHits.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::grid {

/// The ends of the beams of a scan, in the map [m].
class BeamEnds {
 public:
  /// Whether the given pose is that of the base or of the sensor.
  enum class Pose { of_base, of_sensor };

  BeamEnds(const mrpt::obs::CObservation2DRangeScan& scan, const mrpt::poses::CPose3D& pose, Pose which)
      : scan_(scan),
        ranges_(scan.getScanSize() > 0 ? &scan.getScanRange(0) : nullptr),
        directions_(scan.getScanSize()) {
    const auto map_from_sensor = which == Pose::of_base ? pose + scan.sensorPose : pose;
    origin_ = map_from_sensor.translation();
    const auto& rotation = map_from_sensor.getRotationMatrix();
    const double sign = scan.rightToLeft ? 1 : -1;
    const double first = size() > 1 ? -0.5 * sign * scan.aperture : 0;
    const double step = size() > 1 ? sign * scan.aperture / static_cast<double>(size() - 1) : 0;
    // Each direction is the previous one, rotated. Computing the cosine and sine of every direction would take longer
    // than all other work for a grid.
    double c = std::cos(first), s = std::sin(first);
    const double turn_c = std::cos(step), turn_s = std::sin(step);
    const geometry::FloorHits floor(scan.sensorPose);
    if (floor.arePossible()) on_floor_.reserve(size());
    for (auto& direction : directions_) {
      if (floor.arePossible()) {
        const double range = ranges_[on_floor_.size()];
        on_floor_.push_back(floor.holds(range * c, range * s));
      }
      direction = {rotation(0, 0) * c + rotation(0, 1) * s, rotation(1, 0) * c + rotation(1, 1) * s,
                   rotation(2, 0) * c + rotation(2, 1) * s};
      const double next_c = c * turn_c - s * turn_s;
      s = s * turn_c + c * turn_s;
      c = next_c;
    }
  }

  std::size_t size() const { return directions_.size(); }
  mrpt::math::TPoint3D origin() const { return origin_; }
  float range(std::size_t beam) const { return ranges_[beam]; }  ///< [m]
  bool valid(std::size_t beam) const {
    return std::isfinite(ranges_[beam]) && ranges_[beam] > 0 && scan_.getScanRangeValidity(beam);
  }
  /// Whether the beam has an echo: many sensors report their largest range if there is none.
  bool hasEcho(std::size_t beam) const { return valid(beam) && range(beam) < scan_.maxRange; }
  /// Whether the beam ends at something that stands on the floor, and not on the floor.
  bool hits(std::size_t beam) const { return hasEcho(beam) && (on_floor_.empty() || !on_floor_[beam]); }
  /// Whether the beam shows that the way to its end is free: it has an echo, or it is one of at least three
  /// neighbouring beams without one. A single beam without an echo amid others that have one met something dark or a
  /// mirror.
  bool clears(std::size_t beam) const { return hasEcho(beam) || (valid(beam) && isOneOfSeveral(beam)); }
  /// End of the beam, cut at `max_range` [m].
  mrpt::math::TPoint3D at(std::size_t beam, double max_range) const {
    return origin_ + directions_[beam] * std::min<double>(range(beam), max_range);
  }

 private:
  static constexpr std::size_t kFewestWithoutEcho = 3;

  bool hasNoEcho(std::size_t beam) const { return beam < size() && valid(beam) && !hasEcho(beam); }
  bool isOneOfSeveral(std::size_t beam) const {
    std::size_t first = beam, last = beam;
    while (last - first + 1 < kFewestWithoutEcho && first > 0 && hasNoEcho(first - 1)) --first;
    while (last - first + 1 < kFewestWithoutEcho && hasNoEcho(last + 1)) ++last;
    return last - first + 1 >= std::min(kFewestWithoutEcho, size());
  }

  const mrpt::obs::CObservation2DRangeScan& scan_;
  const float* ranges_;  // [m] of the scan, one for each beam
  mrpt::math::TPoint3D origin_;
  std::vector<mrpt::math::TPoint3D> directions_;  // in the map
  std::vector<bool> on_floor_;                    // empty if no beam can be
};

}  // namespace omnimapper::grid

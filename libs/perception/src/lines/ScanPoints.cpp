#include "ScanPoints.h"

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/FloorHits.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::perception::lines {

namespace {

// Smallest variance [m^2] of a point across a line: that of one micrometre. Without it, the variance would be 0 across
// a line along a beam that has no noise to its sides.
constexpr double kLeastVariance = 1e-12;

void reserve(ScanPoints& points, std::size_t count) {
  for (auto* numbers : {&points.ux, &points.uy, &points.x, &points.y, &points.range, &points.across, &points.steep})
    numbers->reserve(count);
  points.beam.reserve(count);
}

}  // namespace

ScanPoints pointsOf(const mrpt::obs::CObservation2DRangeScan& scan, const LaserLineOptions& options) {
  ScanPoints points;
  const std::size_t beams = scan.getScanSize();
  points.beams = static_cast<int>(beams);
  // Without a finite aperture the directions of the beams are unknown.
  if (beams == 0 || !std::isfinite(scan.aperture)) return points;
  reserve(points, beams);
  points.step = beams > 1 ? scan.aperture / static_cast<double>(beams - 1) : 0.0;
  points.all_round = beams > 2 && scan.aperture + 1.5 * points.step >= 2 * geometry::kPi;
  const double sign = scan.rightToLeft ? 1.0 : -1.0;
  const double first = beams > 1 ? -0.5 * scan.aperture * sign : 0.0;
  const double turn_x = std::cos(sign * points.step), turn_y = std::sin(sign * points.step);
  double ux = std::cos(first), uy = std::sin(first);
  const double range_variance = options.range_sigma * options.range_sigma;
  const double rough_variance = options.roughness * options.roughness;
  const double width_variance = options.beam_width * options.beam_width / 12;  // of a uniform distribution
  const geometry::FloorHits floor(scan.sensorPose);
  for (std::size_t i = 0; i < beams; ++i) {
    const double range = scan.getScanRange(i);
    // NaN fails every comparison.
    if (scan.getScanRangeValidity(i) && range >= options.min_range && range <= options.max_range &&
        range < scan.maxRange && !floor.holds(range * ux, range * uy)) {
      points.ux.push_back(ux);
      points.uy.push_back(uy);
      points.x.push_back(range * ux);
      points.y.push_back(range * uy);
      points.range.push_back(range);
      const double sideways = range * range * width_variance;
      points.across.push_back(std::max(rough_variance + sideways, kLeastVariance));
      points.steep.push_back(range_variance - sideways);
      points.beam.push_back(static_cast<int>(i));
    }
    // Rotating the direction by one step is many times faster than a sine for each beam; after 10^4 beams its error is
    // 10^-12.
    const double next = ux * turn_x - uy * turn_y;
    uy = ux * turn_y + uy * turn_x;
    ux = next;
  }
  return points;
}

ScanPoints startingAt(ScanPoints points, int start) {
  for (auto* numbers : {&points.ux, &points.uy, &points.x, &points.y, &points.range, &points.across, &points.steep})
    std::rotate(numbers->begin(), numbers->begin() + start, numbers->end());
  std::rotate(points.beam.begin(), points.beam.begin() + start, points.beam.end());
  return points;
}

}  // namespace omnimapper::perception::lines

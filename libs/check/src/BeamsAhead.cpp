#include "BeamsAhead.h"

#include <mrpt/math/wrap2pi.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/FloorHits.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "Quantile.h"

namespace omnimapper::check {

namespace {

using mrpt::obs::CObservation2DRangeScan;

// Ranges of the beams that look where the robot drives, with their indices as keys. Walls beside the robot stay as far
// away as they are, so that the beams must look well ahead.
std::map<std::size_t, double> ahead(const CObservation2DRangeScan& scan, double direction, double limit) {
  constexpr double kAhead = 8 * base::option_text::kRadiansPerDegree;
  std::map<std::size_t, double> ranges;
  const std::size_t beams = scan.getScanSize();
  if (beams < 2) return ranges;
  const geometry::FloorHits floor(scan.sensorPose);
  const auto rotation = scan.sensorPose.getRotationMatrix();
  const double sign = scan.rightToLeft ? 1 : -1, step = sign * scan.aperture / static_cast<double>(beams - 1);
  for (std::size_t i = 0; i < beams; ++i) {
    const double range = scan.getScanRange(i), angle = -0.5 * sign * scan.aperture + step * static_cast<double>(i);
    const double c = std::cos(angle), s = std::sin(angle);
    const double in_base = std::atan2(rotation(1, 0) * c + rotation(1, 1) * s, rotation(0, 0) * c + rotation(0, 1) * s);
    if (std::abs(mrpt::math::wrapToPi(in_base - direction)) > kAhead) continue;
    const bool is_valid = scan.getScanRangeValidity(i) && std::isfinite(range) && range > 0.1 && range < limit;
    if (is_valid && !floor.holds(range * c, range * s)) ranges[i] = range;
  }
  return ranges;
}

}  // namespace

std::optional<double> constantRangeAhead(const std::vector<ScanPair>& pairs, const OdometryBetween& odometry,
                                         double limit) {
  constexpr double kTravel = 0.2, kTurn = 0.06;  // [m] [rad] of a pair in which the robot drives straight on
  constexpr double kSame = 0.15;                 // of the distance driven, by which a constant range may change
  constexpr double kMost = 0.7;                  // share of the beams, and of the pairs
  constexpr std::size_t kFewestBeams = 3, kFewestPairs = 8;
  std::size_t compared = 0;
  std::vector<double> constant;
  for (const auto& pair : pairs) {
    const auto motion = odometry(pair.begin->timestamp, pair.end->timestamp);
    if (!motion || motion->norm() < kTravel || std::abs(motion->phi()) > kTurn) continue;
    const double direction = std::atan2(motion->y(), motion->x());
    const auto before = ahead(*pair.begin, direction, limit), after = ahead(*pair.end, direction, limit);
    std::size_t both = 0, same = 0;
    std::vector<double> ranges;
    for (const auto& [beam, range] : before) {
      const auto other = after.find(beam);
      if (other == after.end()) continue;
      ++both;
      same += std::abs(range - other->second) < kSame * motion->norm();
      ranges.push_back(range);
    }
    if (both < kFewestBeams) continue;
    ++compared;
    if (static_cast<double>(same) > kMost * static_cast<double>(both)) constant.push_back(quantile(ranges, 0.5));
  }
  if (compared < kFewestPairs || static_cast<double>(constant.size()) < kMost * static_cast<double>(compared))
    return std::nullopt;
  return quantile(constant, 0.5);
}

}  // namespace omnimapper::check

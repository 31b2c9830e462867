#include "BeamsAhead.h"

#include <mrpt/math/wrap2pi.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/FloorHits.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

std::optional<Measured> constantRangeAhead(const std::vector<ScanPair>& pairs, const OdometryBetween& odometry,
                                           double limit) {
  constexpr double kTravel = 0.2, kTurn = 0.06;  // [m] [rad] of a pair in which the robot drives straight on
  constexpr double kSame = 0.15;                 // of the distance driven, by which a constant range may change
  constexpr double kMost = 0.7;                  // share of the beams
  constexpr double kEqual = 0.02;                // of the range, by which constant ranges of several pairs may differ
  constexpr double kLeastShare = 0.2, kFewestBeyond = 0.1;  // of the pairs
  constexpr std::size_t kFewestBeams = 3, kFewestPairs = 4;
  std::vector<double> all, constant;  // [m] median ranges ahead of each pair
  for (const auto& pair : pairs) {
    const auto motion = odometry(pair.begin->timestamp, pair.end->timestamp);
    if (!motion || motion->norm() < kTravel || std::abs(motion->phi()) > kTurn) continue;
    const double direction = std::atan2(motion->y(), motion->x());
    const auto before = ahead(*pair.begin, direction, limit), after = ahead(*pair.end, direction, limit);
    std::size_t same = 0;
    std::vector<double> ranges;
    for (const auto& [beam, range] : before) {
      const auto other = after.find(beam);
      if (other == after.end()) continue;
      same += std::abs(range - other->second) < kSame * motion->norm();
      ranges.push_back(range);
    }
    if (ranges.size() < kFewestBeams) continue;
    all.push_back(quantile(ranges, 0.5));
    if (static_cast<double>(same) > kMost * static_cast<double>(ranges.size())) constant.push_back(all.back());
  }
  if (constant.size() < kFewestPairs) return std::nullopt;
  // The floor and the robot are always at one range, and nothing is seen behind them.
  const double range = quantile(constant, 0.5);
  const auto equal = std::count_if(constant.begin(), constant.end(),
                                   [&](double other) { return std::abs(other - range) < kEqual * range; });
  const auto beyond = std::count_if(all.begin(), all.end(), [&](double other) { return other > 1.1 * range; });
  const double pairs_compared = static_cast<double>(all.size());
  const bool is_constant = equal >= static_cast<std::ptrdiff_t>(kFewestPairs) &&
                           static_cast<double>(equal) > kLeastShare * pairs_compared &&
                           static_cast<double>(equal) > kMost * static_cast<double>(constant.size()) &&
                           static_cast<double>(beyond) < kFewestBeyond * pairs_compared;
  std::vector<double> errors;
  for (const double other : constant) errors.push_back(std::abs(other - range));
  constexpr double kNormal = 1.4826;  // standard deviation divided by the median error
  constexpr double kLeast = 0.01;     // [m] of a laser
  return is_constant ? std::optional(Measured{range, std::max(kLeast, kNormal * quantile(errors, 0.5))}) : std::nullopt;
}

}  // namespace omnimapper::check

#include "ScanPairs.h"

#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/matching/PointToLineMatcher.h>
#include <omnimapper/matching/ScanInBase.h>
#include <omnimapper/perception/LaserPointsExtractor.h>

#include <cmath>
#include <memory>

namespace omnimapper::check {

namespace {

constexpr double kShortest = 0.4, kLongest = 3;  // [s] of a pair
constexpr std::size_t kMostPairs = 400;
constexpr double kLeastOverlap = 0.6;
constexpr double kWallDistance = 0.1;  // [m]

matching::ScanWithNormals wallsOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  static const perception::LaserPointsExtractor extractor{perception::LaserPointsOptions()};
  return matching::scanInBase(dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*extractor.extract(scan)));
}

bool fits(const matching::ScanMatch& match) {
  return match.overlap >= kLeastOverlap && match.wall_distance <= kWallDistance && !match.degenerate;
}

bool isBetter(const matching::ScanMatch& a, const matching::ScanMatch& b) {
  if (std::abs(a.overlap - b.overlap) > 0.02) return a.overlap > b.overlap;
  return a.wall_distance < b.wall_distance;
}

matching::ScanMatcherOptions wideOptions() {
  matching::ScanMatcherOptions options;
  options.max_distance = 1.0;
  return options;
}

}  // namespace

void ScanPairs::add(const ScanPtr& scan) {
  if (!base::isValid(scan->timestamp)) return;
  if (misses_last_) {
    pairs_.back().after_end = scan;
    misses_last_ = false;
    if (pairs_.size() == kMostPairs) {
      for (std::size_t i = 0; 2 * i < pairs_.size(); ++i) pairs_[i] = pairs_[2 * i];
      pairs_.resize(kMostPairs / 2);
      stride_ *= 2;
    }
  }
  if (begin_ && !after_begin_) after_begin_ = scan;
  const double seconds = begin_ ? base::secondsBetween(begin_->timestamp, scan->timestamp) : -1;
  if (seconds >= 0 && seconds < kShortest) return;
  if (seconds >= kShortest && seconds <= kLongest && ended_++ % stride_ == 0) {
    pairs_.push_back({begin_, scan, after_begin_, nullptr});
    misses_last_ = true;
  }
  begin_ = scan;
  after_begin_ = nullptr;
}

std::vector<MeasuredTurn> turnsOf(const std::vector<MatchedMotion>& motions) {
  std::vector<MeasuredTurn> turns;
  for (const auto& motion : motions) turns.push_back({motion.begin, motion.end, motion.by_scans.phi()});
  return turns;
}

std::vector<ScanPair> withAperture(const std::vector<ScanPair>& pairs, double aperture) {
  const auto changed = [&](const ScanPtr& scan) {
    auto copy = std::make_shared<mrpt::obs::CObservation2DRangeScan>(*scan);
    copy->aperture = static_cast<float>(aperture);
    return copy;
  };
  std::vector<ScanPair> copies;
  for (const auto& pair : pairs) copies.push_back({changed(pair.begin), changed(pair.end), nullptr, nullptr});
  return copies;
}

std::vector<MatchedMotion> matchPairs(const std::vector<ScanPair>& pairs, const OdometryBetween& odometry) {
  const matching::PointToLineMatcher matcher(wideOptions());
  std::vector<MatchedMotion> motions;
  for (const auto& pair : pairs) {
    const auto from = matcher.prepare(wallsOf(*pair.begin));
    const auto to = wallsOf(*pair.end);
    const auto by_odometry = odometry(pair.begin->timestamp, pair.end->timestamp);
    auto match = matcher.match(*from, to, mrpt::math::TPose2D(0, 0, 0));
    if (by_odometry) {
      const auto other = matcher.match(*from, to, by_odometry->asTPose());
      if (isBetter(other, match)) match = other;
    }
    if (!fits(match)) continue;
    motions.push_back({pair.begin->timestamp, pair.end->timestamp, mrpt::poses::CPose2D(match.reference_from_scan),
                       by_odometry, match.wall_distance});
  }
  return motions;
}

}  // namespace omnimapper::check

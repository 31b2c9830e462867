#include "WallTrack.h"

#include <omnimapper/perception/LaserLineExtractor.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::check {

namespace {

std::vector<BaseWall> linesOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  static const perception::LaserLineExtractor extractor{perception::LaserLineOptions()};
  std::vector<BaseWall> walls;
  const auto rotation = scan.sensorPose.getRotationMatrix();
  const auto seen = extractor.extract(scan);
  for (const auto& line : seen->lines) {
    const double c = std::cos(line.angle), s = std::sin(line.angle);
    const double x = rotation(0, 0) * c + rotation(0, 1) * s, y = rotation(1, 0) * c + rotation(1, 1) * s;
    const double azimuth = std::atan2(y, x);
    walls.push_back(
        {azimuth, line.distance + std::cos(azimuth) * scan.sensorPose.x() + std::sin(azimuth) * scan.sensorPose.y()});
  }
  return walls;
}

}  // namespace

void WallTrack::add(const ScanPtr& scan) {
  constexpr std::size_t kMost = 3000;
  if (!base::isValid(scan->timestamp)) return;
  // A stamp that lies ahead of those that follow is wrong.
  constexpr double kBack = 1;  // [s]
  while (!scans_.empty() && base::secondsBetween(scan->timestamp, scans_.back()->timestamp) > kBack) scans_.pop_back();
  if (!scans_.empty() && base::secondsBetween(scans_.back()->timestamp, scan->timestamp) < spacing_) return;
  seen_.clear();
  scans_.push_back(scan);
  if (scans_.size() < kMost) return;
  for (std::size_t i = 0; 2 * i < scans_.size(); ++i) scans_[i] = scans_[2 * i];
  scans_.resize(kMost / 2);
  spacing_ *= 2;
}

std::vector<BaseWall> WallTrack::wallsAt(base::Stamp stamp, const OdometryBetween& odometry) const {
  constexpr double kFarthest = 3, kSame = 0.02;  // [s]
  const auto after = std::lower_bound(scans_.begin(), scans_.end(), stamp,
                                      [](const ScanPtr& scan, base::Stamp when) { return scan->timestamp < when; });
  std::size_t nearest = static_cast<std::size_t>(after - scans_.begin());
  const auto away = [&](std::size_t i) { return std::abs(base::secondsBetween(scans_[i]->timestamp, stamp)); };
  if (nearest == scans_.size() || (nearest > 0 && away(nearest - 1) < away(nearest))) {
    if (nearest == 0) return {};
    --nearest;
  }
  if (away(nearest) > kFarthest) return {};
  auto found = seen_.find(nearest);
  if (found == seen_.end()) found = seen_.emplace(nearest, linesOf(*scans_[nearest])).first;
  if (away(nearest) < kSame) return found->second;
  const auto from = scans_[nearest]->timestamp;
  const bool is_later = from < stamp;
  const auto motion = is_later ? odometry(from, stamp) : odometry(stamp, from);
  if (!motion) return {};
  const auto scan_from_then = is_later ? *motion : mrpt::poses::CPose2D() - *motion;
  auto walls = found->second;
  for (auto& wall : walls) {
    wall.distance -= std::cos(wall.azimuth) * scan_from_then.x() + std::sin(wall.azimuth) * scan_from_then.y();
    wall.azimuth -= scan_from_then.phi();
  }
  return walls;
}

}  // namespace omnimapper::check

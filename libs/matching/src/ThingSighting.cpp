#include <omnimapper/matching/ThingSighting.h>

#include <algorithm>

namespace omnimapper::matching {

std::vector<ThingSighting> sightingsIn(const mrpt::math::TPose2D& track_from_scan, const Eigen::Vector2f& sensor,
                                       double seconds, const ScanWithNormals& scan) {
  const ToTrack toTrack(track_from_scan);
  std::vector<ThingSighting> all;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.things[i] == ScanWithNormals::kNoThing) continue;
    if (i == 0 || scan.things[i] != scan.things[i - 1]) {
      all.emplace_back();
      all.back().seconds = seconds;
      all.back().begin = i;
      all.back().viewer = toTrack(sensor);
    }
    all.back().points.push_back(toTrack(scan.points[i]));
  }
  for (auto& sighting : all) sighting.centre = centreOf(sighting.points);
  return all;
}

Eigen::Vector2f centreOf(const std::vector<Eigen::Vector2f>& points) {
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (const auto& point : points) sum += point;
  return sum / static_cast<float>(points.size());
}

float extentOf(const std::vector<Eigen::Vector2f>& points) {
  Eigen::Array2f low = points.front(), high = low;
  for (const auto& point : points) {
    low = low.min(point.array());
    high = high.max(point.array());
  }
  return (high - low).matrix().norm();
}

std::size_t overlapping(const std::vector<Eigen::Vector2f>& points, const std::vector<Eigen::Vector2f>& others) {
  constexpr float kSame = 0.1F;  // [m] between points that may be the same
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Eigen::Vector2f& point) {
    return std::any_of(others.begin(), others.end(),
                       [&](const Eigen::Vector2f& other) { return (point - other).squaredNorm() < kSame * kSame; });
  }));
}

}  // namespace omnimapper::matching

#include <omnimapper/matching/RecentViews.h>
#include <omnimapper/matching/ThingSighting.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

// doc/results/robustness.md has the logs on which these were chosen.
constexpr double kBetweenLooks = 0.3;     // [s]
constexpr float kWidthPerRange = 0.035F;  // two degrees: the beams cannot miss a thing that is wider
constexpr std::size_t kSampled = 8;       // points of a thing that are looked at
constexpr float kFree = 0.7F, kOccupied = 0.3F;

}  // namespace

bool isWideFor(const ScanView& view, const std::vector<Eigen::Vector2f>& points) {
  return extentOf(points) > kWidthPerRange * view.distance(centreOf(points));
}

SeenShares sharesSeen(const ScanView& view, const std::vector<Eigen::Vector2f>& points, float margin) {
  SeenShares shares;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSampled);
  const auto one = 1 / static_cast<float>((points.size() + step - 1) / step);
  for (std::size_t i = 0; i < points.size(); i += step) {
    const auto seen = view.at(points[i], margin);
    if (seen == ScanView::Seen::free) shares.free += one;
    if (seen == ScanView::Seen::occupied) shares.occupied += one;
  }
  return shares;
}

void RecentViews::add(const ScanView& view, double seconds) {
  if (!looks_.empty() && seconds - looks_.back().seconds < kBetweenLooks) return;
  looks_.push_back({view, seconds});
  while (seconds - looks_.front().seconds > kKept) looks_.pop_front();
}

RecentViews::Counts RecentViews::at(const Eigen::Vector2f& place, float margin, double until) const {
  Counts counts;
  for (const auto& look : looks_) {
    if (look.seconds > until) break;
    const auto seen = look.view.at(place, margin);
    counts.free += seen == ScanView::Seen::free;
    counts.occupied += seen == ScanView::Seen::occupied;
  }
  return counts;
}

RecentViews::Counts RecentViews::at(const std::vector<Eigen::Vector2f>& points, float margin, double until) const {
  constexpr float kRounding = 1e-3F;
  Counts counts;
  for (const auto& look : looks_) {
    if (look.seconds > until) break;
    if (!isWideFor(look.view, points)) continue;
    const auto shares = sharesSeen(look.view, points, margin);
    counts.free += shares.free > kFree - kRounding;
    counts.occupied += shares.occupied > kOccupied - kRounding;
  }
  return counts;
}

bool RecentViews::contradict(const TPose2D& track_from_scan, const ScanWithNormals& scan) const {
  constexpr std::size_t kMostLooked = 60;
  constexpr int kFewWalls = 10;
  constexpr float kPassedBy = 0.2F;  // [m]
  if (looks_.empty()) return false;
  const std::size_t step = std::max<std::size_t>(1, scan.size() / kMostLooked);
  const ToTrack toTrack(track_from_scan);
  int walls = 0, wrong = 0;
  for (std::size_t i = 0; i < scan.size(); i += step) {
    if (scan.things[i] != ScanWithNormals::kNoThing || scan.normals[i].squaredNorm() < 0.5F) continue;
    ++walls;
    wrong += at(toTrack(scan.points[i]), kPassedBy, looks_.back().seconds).isFree();
  }
  return walls >= kFewWalls && 10 * wrong > walls;
}

}  // namespace omnimapper::matching

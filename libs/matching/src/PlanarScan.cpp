#include <omnimapper/matching/PlanarScan.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

namespace {

constexpr float kLargestGap = 0.6F;    // [m] between neighbours on one wall
constexpr float kLongestReach = 2.0F;  // [m] from a point to the end of its window

// Neighbours on each side, and how thin they have to lie for a line: squared width over squared length. The widest
// window takes what a noisy sensor gives.
struct WindowLimit {
  int half;
  float thinness;
};
constexpr WindowLimit kWindows[] = {{2, 0.01F}, {4, 0.01F}, {8, 0.02F}, {16, 0.04F}, {32, 0.15F}};

// Mean and scatter of the neighbours of point `centre`, at most `half` on each side and none beyond a gap.
struct Window {
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  float xx = 0, xy = 0, yy = 0;
  int count = 0;
};

Window gather(const std::vector<Eigen::Vector2f>& points, int centre, int half) {
  int first = centre, last = centre;
  const auto& middle = points[centre];
  const auto joins = [&](int from, int to) {
    return (points[to] - points[from]).norm() <= kLargestGap && (points[to] - middle).norm() <= kLongestReach;
  };
  while (first > 0 && centre - first < half && joins(first, first - 1)) --first;
  while (last + 1 < static_cast<int>(points.size()) && last - centre < half && joins(last, last + 1)) ++last;
  Window window;
  window.count = last - first + 1;
  for (int i = first; i <= last; ++i) window.mean += points[i];
  window.mean /= static_cast<float>(window.count);
  for (int i = first; i <= last; ++i) {
    const Eigen::Vector2f d = points[i] - window.mean;
    window.xx += d.x() * d.x();
    window.xy += d.x() * d.y();
    window.yy += d.y() * d.y();
  }
  return window;
}

}  // namespace

PlanarScan fitLines(const std::vector<Eigen::Vector2f>& points) {
  PlanarScan scan;
  scan.points.reserve(points.size());
  scan.normals.reserve(points.size());
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    Eigen::Vector2f point = points[i], normal = Eigen::Vector2f::Zero();
    int previous_count = 0;
    for (const auto& [half, thinness] : kWindows) {
      const Window window = gather(points, i, half);
      if (window.count < 4 || window.count == previous_count) continue;
      previous_count = window.count;
      // Eigenvalues of the scatter: the larger along the wall, the smaller across.
      const float mean = 0.5F * (window.xx + window.yy), half_difference = 0.5F * (window.xx - window.yy);
      const float root = std::hypot(half_difference, window.xy);
      if (!(mean - root < thinness * (mean + root))) continue;
      const float along = 0.5F * std::atan2(window.xy, half_difference);
      normal = {-std::sin(along), std::cos(along)};
      point -= normal * normal.dot(point - window.mean);
      break;
    }
    scan.points.push_back(point);
    scan.normals.push_back(normal);
  }
  return scan;
}

void append(const PlanarScan& scan, const mrpt::math::TPose2D& target_from_scan, PlanarScan& target) {
  const auto c = static_cast<float>(std::cos(target_from_scan.phi)),
             s = static_cast<float>(std::sin(target_from_scan.phi));
  const auto tx = static_cast<float>(target_from_scan.x), ty = static_cast<float>(target_from_scan.y);
  target.points.reserve(target.size() + scan.size());
  target.normals.reserve(target.size() + scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto& p = scan.points[i];
    const auto& n = scan.normals[i];
    target.points.emplace_back(tx + c * p.x() - s * p.y(), ty + s * p.x() + c * p.y());
    target.normals.emplace_back(c * n.x() - s * n.y(), s * n.x() + c * n.y());
  }
}

}  // namespace omnimapper::matching

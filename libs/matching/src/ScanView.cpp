#include <omnimapper/matching/ScanView.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

int ScanView::binOf(const Eigen::Vector2f& direction) {
  const double turn = std::atan2(direction.y(), direction.x()) / (2 * M_PI) + 0.5;
  return std::clamp(static_cast<int>(turn * kBins), 0, kBins - 1);
}

// A wall between two neighbouring points fills the directions between them.
ScanView::ScanView(const mrpt::math::TPose2D& frame_from_scan, const Eigen::Vector2f& sensor,
                   const ScanWithNormals& scan) {
  constexpr float kJoined = 0.6F;  // [m] between neighbours on one wall
  const auto c = static_cast<float>(std::cos(frame_from_scan.phi)),
             s = static_cast<float>(std::sin(frame_from_scan.phi));
  const auto turned = [&](const Eigen::Vector2f& p) {
    return Eigen::Vector2f(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  };
  origin_ =
      Eigen::Vector2f(static_cast<float>(frame_from_scan.x), static_cast<float>(frame_from_scan.y)) + turned(sensor);
  nearest_.fill(0);
  const auto put = [&](int bin, float range) {
    float& nearest = nearest_[static_cast<std::size_t>((bin % kBins + kBins) % kBins)];
    nearest = nearest > 0 ? std::min(nearest, range) : range;
  };
  int before = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector2f direction = turned(scan.points[i] - sensor);
    const float range = direction.norm();
    const int bin = binOf(direction);
    put(bin, range);
    if (i > 0 && (scan.points[i] - scan.points[i - 1]).squaredNorm() < kJoined * kJoined) {
      const int steps = ((bin - before) % kBins + kBins + kBins / 2) % kBins - kBins / 2;
      const int sign = steps > 0 ? 1 : -1;
      for (int k = 1; k < std::abs(steps); ++k) put(before + sign * k, range);
    }
    before = bin;
  }
}

ScanView::Seen ScanView::at(const Eigen::Vector2f& place, float margin) const {
  const Eigen::Vector2f direction = place - origin_;
  const float range = direction.norm();
  const int middle = binOf(direction);
  float least = 0;
  for (int k = -1; k <= 1; ++k) {
    const float nearest = nearest_[static_cast<std::size_t>((middle + k + kBins) % kBins)];
    if (nearest == 0) return Seen::unknown;
    least = k == -1 ? nearest : std::min(least, nearest);
  }
  if (least > range + margin) return Seen::free;
  return least < range - margin ? Seen::hidden : Seen::occupied;
}

}  // namespace omnimapper::matching

#include "Gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Walls.h"

namespace omnimapper::building {

namespace {

/// Walks along the line of a wall, in half cells, and finds the free stretches between obstacles.
class GapWalk {
 public:
  GapWalk(const FreeSpace& space, const Wall& wall, const SegmentationOptions& options)
      : space_(space),
        wall_(wall),
        across_(-wall.direction.y, wall.direction.x),
        longest_(options.longest_opening / space.cell) {}

  void addTo(std::vector<Cut>& cuts) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& part : wall_.parts) {
      low = std::min(low, part.from);
      high = std::max(high, part.to);
    }
    bool is_open = false;
    double begin = 0;
    for (double place = low - longest_ - 2; place <= high + longest_ + 2; place += kStep) {
      const bool is_free = isFree(place);
      if (is_free && !is_open) begin = place;
      if (!is_free && is_open && isGap(begin, place)) {
        Cut cut;
        cut.from = obstacleAt(begin - kStep);
        cut.to = obstacleAt(place);
        cuts.push_back(std::move(cut));
      }
      is_open = is_free;
    }
  }

 private:
  static constexpr double kStep = 0.5;  // [cells]

  int band() const { return std::max(1, cvRound(0.1 / space_.cell)); }
  bool isFree(double place) const {
    const cv::Point2d middle = wall_.at(place);
    for (int i = 0; i <= band(); ++i)
      if (!space_.isFree(middle + across_ * i) || !space_.isFree(middle - across_ * i)) return false;
    return true;
  }
  cv::Point2d obstacleAt(double place) const {
    const cv::Point2d middle = wall_.at(place);
    for (int i = 0; i <= band(); ++i)
      for (const int side : {1, -1})
        if (!space_.isFree(middle + across_ * (i * side))) return middle + across_ * (i * side);
    return middle;
  }
  /// Whether a free stretch is next to a part of the wall, and of a width that a passage can have.
  bool isGap(double begin, double end) const {
    constexpr double kNarrowest = 0.35, kNext = 0.5;  // [m]
    if ((end - begin) * space_.cell < kNarrowest || end - begin > longest_) return false;
    const double next = kNext / space_.cell;
    return std::any_of(wall_.parts.begin(), wall_.parts.end(), [&](const Wall::Part& part) {
      return std::abs(part.to - begin) < next || std::abs(part.from - end) < next ||
             (part.from < begin && part.to > end);
    });
  }

  const FreeSpace& space_;
  const Wall& wall_;
  cv::Point2d across_;
  double longest_;
};

}  // namespace

std::vector<Cut> gapsOfWalls(const FreeSpace& space, const SegmentationOptions& options) {
  std::vector<Cut> cuts;
  for (const Wall& wall : wallsOf(facesOf(space, options), space.cell, options))
    if (wall.length * space.cell >= options.shortest_wall) GapWalk(space, wall, options).addTo(cuts);
  return cuts;
}

}  // namespace omnimapper::building

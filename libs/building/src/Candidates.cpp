#include "Candidates.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "Gaps.h"
#include "NarrowPlaces.h"

namespace omnimapper::building {

namespace {

/// Looks for walls around cuts.
class WallSight {
 public:
  explicit WallSight(const FreeSpace& space) : space_(space), step_(std::max(1.0, 0.05 / space.cell)) {
    cv::dilate(space.occupied, measured_, disc(0.05 / space.cell));
  }

  WallsAround around(const Cut& cut) const {
    const cv::Point2d along = cut.direction(), normal = cut.normal();
    const double before = alignedShare(cut.from, -along), after = alignedShare(cut.to, along);
    const double first = crossingShare(cut.from, along, normal), second = crossingShare(cut.to, along, normal);
    return {std::min(before, after), std::max(before, after), 0.5 * (first + second), std::max(first, second)};
  }

 private:
  // [m]
  static constexpr double kSight = 3, kAlignedBand = 0.2, kThickest = 0.45;
  static constexpr double kCrossingFrom = 0.15, kCrossingTo = 0.8, kCrossingBand = 0.15;

  bool isMeasured(const cv::Point2d& at) const {
    const int x = cvRound(at.x), y = cvRound(at.y);
    return space_.contains(x, y) && measured_.at<std::uint8_t>(y, x) != 0 && !space_.isFree(at);
  }
  bool isInSpace(const cv::Point2d& at) const { return space_.contains(cvRound(at.x), cvRound(at.y)); }

  /// Share of the line from `end` that is on a wall with free space on at least one side.
  double alignedShare(const cv::Point2d& end, const cv::Point2d& along) const {
    const cv::Point2d across(-along.y, along.x);
    const double band = kAlignedBand / space_.cell, thickest = kThickest / space_.cell;
    int walls = 0, count = 0;
    for (double place = step_; place * space_.cell <= kSight; place += step_, ++count) {
      const cv::Point2d at = end + along * place;
      bool is_wall = false, is_at_free = false;
      for (double off = -band; off <= band + 0.01 && !is_wall; off += 1) is_wall = isMeasured(at + across * off);
      for (double off = 1; off <= thickest && is_wall && !is_at_free; off += 1)
        is_at_free = space_.isFree(at + across * off) || space_.isFree(at - across * off);
      walls += is_at_free ? 1 : 0;
    }
    return static_cast<double>(walls) / count;
  }
  /// Share of wall across the end of a cut, on the side of the normal where there is less of it.
  double crossingShare(const cv::Point2d& end, const cv::Point2d& along, const cv::Point2d& normal) const {
    const double band = kCrossingBand / space_.cell;
    double least = 1;
    for (const double side : {1.0, -1.0}) {
      int walls = 0, count = 0;
      for (double place = kCrossingFrom / space_.cell; place * space_.cell <= kCrossingTo; place += step_, ++count) {
        bool is_wall = false;
        for (double off = -band; off <= band + 0.01 && !is_wall; off += 1)
          is_wall = !space_.isFree(end + normal * (side * place) + along * off);
        walls += is_wall ? 1 : 0;
      }
      least = std::min(least, static_cast<double>(walls) / count);
    }
    return least;
  }

  const FreeSpace& space_;
  double step_;
  cv::Mat measured_;
};

bool isSamePlace(const Cut& a, const Cut& b, double distance) {
  const auto close = [&](const cv::Point2d& p, const cv::Point2d& q) { return cv::norm(p - q) < distance; };
  return (close(a.from, b.from) && close(a.to, b.to)) || (close(a.from, b.to) && close(a.to, b.from));
}

/// Lower is better: narrow, and with walls in line with it.
double rank(const Cut& cut, double cell) {
  constexpr double kWorthOfWall = 1.5;  // [m] of width
  return cut.width() * cell - kWorthOfWall * (cut.walls.less_aligned + cut.walls.more_aligned);
}

}  // namespace

std::vector<Cut> candidateCuts(const FreeSpace& space, const SegmentationOptions& options) {
  constexpr double kWide = 1.5;          // [m] wider gaps need a wall on both sides
  constexpr double kLeastAligned = 0.1;  // share
  const WallSight sight(space);
  std::vector<Cut> all = narrowPlaces(space);
  for (Cut& cut : all) cut.walls = sight.around(cut);
  for (Cut& cut : gapsOfWalls(space, options)) {
    cut.walls = sight.around(cut);
    if (cut.width() * space.cell <= kWide || cut.walls.less_aligned >= kLeastAligned) all.push_back(std::move(cut));
  }
  std::stable_sort(all.begin(), all.end(),
                   [&](const Cut& a, const Cut& b) { return rank(a, space.cell) < rank(b, space.cell); });
  std::vector<Cut> kept;
  for (Cut& cut : all) {
    const auto isSame = [&](const Cut& other) { return isSamePlace(cut, other, options.same_place / space.cell); };
    if (std::none_of(kept.begin(), kept.end(), isSame)) kept.push_back(std::move(cut));
  }
  return kept;
}

}  // namespace omnimapper::building

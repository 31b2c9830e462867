#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace omnimapper::building {

/// What is on both sides of a place of a cut: numbers of pieces (Pieces.h), 0 for none.
struct Sides {
  int left = 0, right = 0;
};

/// What the walls around a cut say, as shares in [0, 1].
struct WallsAround {
  double less_aligned = 0, more_aligned = 0;  ///< wall on the line of the cut, beyond either end
  double crossing = 0, most_crossing = 0;     ///< wall that runs on through the ends: mean, and the larger of both
};

/// A line through free space from obstacle to obstacle, at which a room may end [cells]. Its left side is that to which
/// normal() points.
struct Cut {
  cv::Point2d from, to;
  WallsAround walls;
  double left_clearance = 0, right_clearance = 0;  ///< radius of the largest free circle close to either side
  std::vector<Sides> opening;                      ///< along the cut
  std::vector<Sides> beyond;                       ///< along its line beyond both ends, where there is wall

  double length() const { return cv::norm(to - from); }
  double width() const { return length() - 1; }  ///< the ends are obstacle cells
  cv::Point2d direction() const { return (to - from) / length(); }
  cv::Point2d normal() const {
    const cv::Point2d along = direction();
    return {-along.y, along.x};
  }
};

}  // namespace omnimapper::building

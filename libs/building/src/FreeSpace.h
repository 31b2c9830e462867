#pragma once

#include <omnimapper/building/SegmentationOptions.h>
#include <omnimapper/grid/GridMap.h>

#include <opencv2/core.hpp>
#include <vector>

namespace omnimapper::building {

/// The free space of a grid without clutter and small gaps, in working cells: several fine cells of the grid make one.
/// Points and lengths are in working cells; (0, 0) is the middle of the first one, and cells beyond the grid form a
/// margin that is not free, so that each free cell has eight neighbours.
struct FreeSpace {
  double cell = 0;    ///< [m] side of a working cell
  int factor = 1;     ///< cells of the grid in a row of a working cell
  cv::Mat free;       ///< CV_8U, 255 for free
  cv::Mat occupied;   ///< CV_8U, 255 for measured obstacles
  cv::Mat clearance;  ///< CV_32F, distance to the nearest cell that is not free

  static constexpr int kMargin = 2;

  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < free.cols && y < free.rows; }
  bool isFree(const cv::Point2d& point) const {
    const int x = cvRound(point.x), y = cvRound(point.y);
    return contains(x, y) && free.at<std::uint8_t>(y, x) != 0;
  }
  /// A point in the frame of the grid [m].
  Eigen::Vector2d inGrid(const cv::Point2d& point) const {
    return Eigen::Vector2d(point.x - kMargin + 0.5, point.y - kMargin + 0.5) * cell;
  }
};

FreeSpace freeSpaceOf(const grid::GridMap& grid, const SegmentationOptions& options);

/// The columns (or rows) of working cells of the first `count` columns (or rows) of a grid.
std::vector<int> workingCells(int count, int factor);

/// A disc for morphology, of this radius [cells], at least 1.
cv::Mat disc(double radius);

}  // namespace omnimapper::building

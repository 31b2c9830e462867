#include "FreeSpace.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "Walls.h"

namespace omnimapper::building {

namespace {

using grid::GridCell;

constexpr double kFinest = 0.04;  // [m] cells below this are joined
constexpr double kUsual = 0.05;   // [m]

int factorOf(double resolution) {
  return resolution < kFinest ? std::max(1, cvRound(kUsual / resolution)) : 1;
}

/// A working cell is occupied if one of its cells is, and otherwise free if one of its cells is.
void enter(const grid::GridMap& grid, FreeSpace& space) {
  const int columns = (grid.columns + space.factor - 1) / space.factor + 2 * FreeSpace::kMargin,
            rows = (grid.rows + space.factor - 1) / space.factor + 2 * FreeSpace::kMargin;
  space.free = cv::Mat::zeros(rows, columns, CV_8U);
  space.occupied = cv::Mat::zeros(rows, columns, CV_8U);
  const std::vector<int> columns_of = workingCells(grid.columns, space.factor);
  const GridCell* cell = grid.cells.data();
  for (int row = 0; row < grid.rows; ++row) {
    const int y = row / space.factor + FreeSpace::kMargin;
    std::uint8_t *free = space.free.ptr(y), *occupied = space.occupied.ptr(y);
    for (int column = 0; column < grid.columns; ++column, ++cell) {
      if (*cell == GridCell::free) free[columns_of[column]] = 255;
      if (*cell == GridCell::occupied) occupied[columns_of[column]] = 255;
    }
  }
  space.free.setTo(0, space.occupied);
}

void clearMargin(cv::Mat& mask) {
  for (int i = 0; i < FreeSpace::kMargin; ++i) {
    mask.row(i) = 0;
    mask.row(mask.rows - 1 - i) = 0;
    mask.col(i) = 0;
    mask.col(mask.cols - 1 - i) = 0;
  }
}

/// Fills gaps between the beams of a scan, which are unknown cells between free ones.
void fillGaps(FreeSpace& space) {
  constexpr double kGap = 0.1;  // [m]
  cv::Mat closed;
  cv::morphologyEx(space.free, closed, cv::MORPH_CLOSE, disc(kGap / space.cell));
  closed.setTo(0, space.occupied);
  space.free |= closed;
  clearMargin(space.free);
}

/// Groups of connected cells that are not free and as small as clutter.
struct Things {
  cv::Mat labels, boxes;
  std::vector<char> is_clutter;
};

Things thingsOf(const FreeSpace& space, double largest) {
  Things things;
  cv::Mat obstacles, middles;
  cv::bitwise_not(space.free, obstacles);
  const int count = cv::connectedComponentsWithStats(obstacles, things.labels, things.boxes, middles, 8, CV_32S);
  things.is_clutter.assign(count, 0);
  for (int i = 1; i < count; ++i) {
    const double diagonal =
        std::hypot(things.boxes.at<int>(i, cv::CC_STAT_WIDTH), things.boxes.at<int>(i, cv::CC_STAT_HEIGHT));
    things.is_clutter[i] = diagonal * space.cell < largest ? 1 : 0;
  }
  things.is_clutter[things.labels.at<int>(0, 0)] = 0;  // what is around the grid
  return things;
}

void freeClutter(const Things& things, cv::Mat& free) {
  for (int y = 0; y < free.rows; ++y) {
    const int* label = things.labels.ptr<int>(y);
    std::uint8_t* cell = free.ptr(y);
    for (int x = 0; x < free.cols; ++x)
      if (things.is_clutter[label[x]] != 0) cell[x] = 255;
  }
}

/// Strips along the walls and beyond their ends.
cv::Mat stripsOfWalls(const FreeSpace& space, const SegmentationOptions& options) {
  constexpr double kLongEnough = 1.5, kBeyond = 3, kWidth = 0.25;  // [m]
  cv::Mat strips = cv::Mat::zeros(space.free.size(), CV_8U);
  for (const Wall& wall : wallsOf(facesOf(space, options), space.cell, options)) {
    if (wall.length * space.cell < kLongEnough) continue;
    for (const auto& part : wall.parts)
      cv::line(strips, wall.at(part.from - kBeyond / space.cell), wall.at(part.to + kBeyond / space.cell), 255,
               std::max(1, cvRound(kWidth / space.cell)));
  }
  return strips;
}

/// A small thing in the line of a wall, as between two doors, is a part of the wall.
void keepPartsOfWalls(const cv::Mat& strips, double cell, Things& things) {
  constexpr double kSmallest = 0.25;    // [m] legs of tables are smaller
  constexpr double kLeastInside = 0.8;  // share of the thing
  std::vector<int> inside(things.is_clutter.size(), 0);
  for (int y = 0; y < strips.rows; ++y)
    for (int x = 0; x < strips.cols; ++x)
      if (strips.at<std::uint8_t>(y, x) != 0) ++inside[things.labels.at<int>(y, x)];
  for (int i = 1; i < static_cast<int>(inside.size()); ++i) {
    const double diagonal =
        std::hypot(things.boxes.at<int>(i, cv::CC_STAT_WIDTH), things.boxes.at<int>(i, cv::CC_STAT_HEIGHT));
    if (diagonal * cell >= kSmallest && inside[i] >= kLeastInside * things.boxes.at<int>(i, cv::CC_STAT_AREA))
      things.is_clutter[i] = 0;
  }
}

}  // namespace

std::vector<int> workingCells(int count, int factor) {
  std::vector<int> cells(count);
  for (int i = 0; i < count; ++i) cells[i] = i / factor + FreeSpace::kMargin;
  return cells;
}

cv::Mat disc(double radius) {
  const int cells = std::max(1, cvRound(radius));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * cells + 1, 2 * cells + 1});
}

FreeSpace freeSpaceOf(const grid::GridMap& grid, const SegmentationOptions& options) {
  FreeSpace space;
  space.factor = factorOf(grid.resolution);
  space.cell = grid.resolution * space.factor;
  enter(grid, space);
  fillGaps(space);
  Things things = thingsOf(space, options.clutter);
  FreeSpace without_clutter = space;
  without_clutter.free = space.free.clone();
  freeClutter(things, without_clutter.free);
  keepPartsOfWalls(stripsOfWalls(without_clutter, options), space.cell, things);
  freeClutter(things, space.free);
  cv::distanceTransform(space.free, space.clearance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  // OpenCV squares columns as floats, which are exact up to 4096: beyond, cells that are not free get a distance.
  cv::max(space.clearance, 1, space.clearance);
  space.clearance.setTo(0, space.free == 0);
  return space;
}

}  // namespace omnimapper::building

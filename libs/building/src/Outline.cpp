#include "Outline.h"

#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/Simplify.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace omnimapper::building {

namespace {

using Loop = std::vector<Eigen::Vector2d>;

/// The corners of a contour of cells, simplified, in the map. A contour runs through the middles of cells; one or two
/// cells, which would have no area, have their outer corners instead.
Loop loopOf(const FreeSpace& space, const geometry::Se2& map_from_grid, const std::vector<cv::Point>& contour,
            const cv::Point& corner) {
  constexpr double kTolerance = 0.1;  // [m]
  Loop all;
  if (contour.size() < 3) {
    const cv::Rect box = cv::boundingRect(contour) + corner;
    const cv::Point2d low = cv::Point2d(box.tl()) - cv::Point2d(0.5, 0.5), size(box.width, box.height);
    for (const auto& at : {low, low + cv::Point2d(size.x, 0), low + size, low + cv::Point2d(0, size.y)})
      all.push_back(map_from_grid * space.inGrid(at));
    return all;
  }
  for (const cv::Point& point : contour) all.push_back(map_from_grid * space.inGrid(point + corner));
  Loop loop;
  for (const std::size_t i : geometry::keptOfLoop(all, kTolerance)) loop.push_back(all[i]);
  return loop;
}

void orient(Loop& loop, bool counter_clockwise) {
  if ((geometry::area(loop) > 0) != counter_clockwise) std::reverse(loop.begin(), loop.end());
}

}  // namespace

void outline(const FreeSpace& space, const geometry::Se2& map_from_grid, const cv::Mat& mask, const cv::Point& corner,
             Room& room) {
  constexpr double kLeastHole = 0.25;  // [m^2]
  std::vector<std::vector<cv::Point>> contours;
  std::vector<cv::Vec4i> tree;  // the fourth number is the parent's
  cv::findContours(mask.clone(), contours, tree, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  double largest = -1;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    Loop loop = loopOf(space, map_from_grid, contours[i], corner);
    const double size = std::abs(geometry::area(loop));
    const bool is_hole = tree[i][3] >= 0;
    orient(loop, !is_hole);
    if (is_hole && size >= kLeastHole) room.holes.push_back(std::move(loop));
    if (!is_hole && size > largest) {
      largest = size;
      room.outline = std::move(loop);
    }
  }
  cv::Mat clearance;
  cv::copyMakeBorder(mask, clearance, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::distanceTransform(clearance, clearance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  double radius = 0;
  cv::Point middle;
  cv::minMaxLoc(clearance, nullptr, &radius, nullptr, &middle);
  room.centre = map_from_grid * space.inGrid(middle + corner - cv::Point(1, 1));
  room.clearance = radius * space.cell;
}

}  // namespace omnimapper::building

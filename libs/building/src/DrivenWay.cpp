#include <omnimapper/building/DrivenWay.h>
#include <omnimapper/geometry/Segment2.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::building {

namespace {

void freeAround(grid::GridMap& grid, const geometry::Segment2& segment, double radius) {
  const int reach = static_cast<int>(std::ceil(radius / grid.resolution)) + 1;
  const Eigen::Vector2i from = grid.cellOf(segment.from), to = grid.cellOf(segment.to);
  const Eigen::Vector2i size(grid.columns, grid.rows), around(reach, reach);
  const Eigen::Vector2i low = (from.cwiseMin(to) - around).cwiseMax(0);
  const Eigen::Vector2i high = (from.cwiseMax(to) + around).cwiseMin(size - Eigen::Vector2i(1, 1));
  for (int y = low.y(); y <= high.y(); ++y)
    for (int x = low.x(); x <= high.x(); ++x)
      if (geometry::distance(segment, grid.middleOf({x, y})) <= radius)
        grid.cells[grid.indexOf({x, y})] = grid::GridCell::free;
}

}  // namespace

void freeDrivenWay(grid::GridMap& grid, const std::vector<Eigen::Vector2d>& way, double radius, double longest_step) {
  for (std::size_t i = 0; i < way.size(); ++i) {
    const bool is_step = i > 0 && (way[i] - way[i - 1]).norm() <= longest_step;
    freeAround(grid, {is_step ? way[i - 1] : way[i], way[i]}, radius);
  }
}

}  // namespace omnimapper::building

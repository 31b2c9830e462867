#include <omnimapper/building/RoomsOfCells.h>

#include <opencv2/imgproc.hpp>

namespace omnimapper::building {

std::vector<std::int32_t> roomsOfCells(const Storey& storey, const grid::GridMap& grid) {
  std::vector<std::int32_t> rooms(grid.cells.size(), 0);
  if (rooms.empty()) return rooms;
  cv::Mat picture(grid.rows, grid.columns, CV_32S, rooms.data());
  // Drawing takes as long as an outline is high, so corners far outside are drawn closer.
  const Eigen::Vector2i size(grid.columns, grid.rows);
  for (const Room& room : storey.rooms) {
    std::vector<std::vector<cv::Point>> loops;
    const auto add = [&](const std::vector<Eigen::Vector2d>& corners) {
      auto& loop = loops.emplace_back();
      for (const Eigen::Vector2d& corner : corners) {
        const Eigen::Vector2i cell = grid.cellOf(corner).cwiseMax(-size).cwiseMin(2 * size);
        loop.emplace_back(cell.x(), cell.y());
      }
    };
    if (room.outline.empty()) continue;
    add(room.outline);
    for (const auto& hole : room.holes)
      if (!hole.empty()) add(hole);
    cv::fillPoly(picture, loops, room.id);
  }
  return rooms;
}

}  // namespace omnimapper::building

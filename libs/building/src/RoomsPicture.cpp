#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/RoomsPicture.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/draw/Legend.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace omnimapper::building {

namespace {

/// Colours whose hues are far apart for neighbouring ids.
draw::Rgb colourOf(const Room& room) {
  constexpr double kGolden = 0.618033988749895, kThird = 1.0 / 3;
  const double hue = std::fmod(room.id * kGolden, 1.0), strength = room.isOpen() ? 0.22 : 0.45;
  const auto channel = [&](double at) {
    const double distance = std::abs(std::fmod(hue + at, 1.0) - 0.5) * 6 - 1;
    return static_cast<std::uint8_t>(255 * (1 - strength * (1 - std::clamp(distance, 0.0, 1.0))));
  };
  return {channel(0), channel(2 * kThird), channel(kThird)};
}

/// The cells of a grid that are shown.
struct View {
  int min_x = std::numeric_limits<int>::max(), min_y = min_x, max_x = -1, max_y = -1, scale = 1;

  explicit View(const grid::GridMap& grid) {
    constexpr int kMargin = 10, kWanted = 1600, kLargest = 4;  // [cells], [px]
    for (int y = 0; y < grid.rows; ++y) {
      for (int x = 0; x < grid.columns; ++x) {
        if (grid.at({x, y}) == grid::GridCell::unknown) continue;
        min_x = std::min(min_x, x);
        max_x = std::max(max_x, x);
        min_y = std::min(min_y, y);
        max_y = y;
      }
    }
    if (max_x < 0) min_x = min_y = 0;
    min_x = std::max(0, min_x - kMargin);
    min_y = std::max(0, min_y - kMargin);
    max_x = std::max(0, std::min(grid.columns - 1, max_x + kMargin));
    max_y = std::max(0, std::min(grid.rows - 1, max_y + kMargin));
    scale = std::clamp(kWanted / std::max(max_x - min_x + 1, max_y - min_y + 1), 1, kLargest);
  }
  draw::PixelPoint pixel(const grid::GridMap& grid, const Eigen::Vector2d& point) const {
    const Eigen::Vector2d cell = geometry::inverse(grid.map_from_grid) * point / grid.resolution;
    return {(cell.x() - min_x) * scale, (max_y + 1 - cell.y()) * scale};
  }
};

void paintCells(const grid::GridMap& grid, const Segmentation& rooms, const View& view, draw::Image& picture) {
  constexpr draw::Rgb kUnknown{205, 205, 205}, kFree{255, 255, 255}, kOccupied{0, 0, 0};
  std::map<int, draw::Rgb> colours;
  for (const Room& room : rooms.storey.rooms) colours[room.id] = colourOf(room);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Eigen::Vector2i cell(view.min_x + x / view.scale, view.max_y - y / view.scale);
      const grid::GridCell what = grid.at(cell);
      const int room = rooms.room_of_cell[grid.indexOf(cell)];
      picture.at(x, y) = what == grid::GridCell::occupied ? kOccupied
                         : room != 0                      ? colours[room]
                         : what == grid::GridCell::free   ? kFree
                                                          : kUnknown;
    }
  }
}

void labelRooms(const grid::GridMap& grid, const Segmentation& rooms, const View& view, draw::Image& picture) {
  constexpr int kLetterWidth = 6, kLetterHeight = 13;  // [px]
  for (const Room& room : rooms.storey.rooms) {
    const std::string text = base::printable(labelOf(room)) + ": " + base::fixed(room.area, 1) + " m2";
    const auto at = view.pixel(grid, room.centre);
    drawLabel(picture, static_cast<int>(at.x) - kLetterWidth * static_cast<int>(text.size()) / 2,
              static_cast<int>(at.y) - kLetterHeight / 2, text);
  }
}

}  // namespace

draw::Image drawRooms(const grid::GridMap& grid, const Segmentation& rooms) {
  const View view(grid);
  draw::Image picture((view.max_x - view.min_x + 1) * view.scale, (view.max_y - view.min_y + 1) * view.scale, {});
  paintCells(grid, rooms, view, picture);
  constexpr double kDoorWidth = 1.5;  // [cells]
  for (const Door& door : rooms.storey.doors)
    drawLine(picture, view.pixel(grid, door.opening.from), view.pixel(grid, door.opening.to),
             {{210, 20, 20}, std::max(2.0, kDoorWidth * view.scale), 1});
  labelRooms(grid, rooms, view, picture);
  return picture;
}

}  // namespace omnimapper::building

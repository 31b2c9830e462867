#include <omnimapper/derived/GridPicture.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace omnimapper::derived {

namespace {

constexpr draw::Rgb kUnknown{226, 231, 237}, kFree{255, 255, 255}, kWall{24, 33, 47};
/// Number of shades from unknown to free, and from there to wall, for pixels that cover several cells.
constexpr int kShades = 8;

constexpr std::uint8_t shade(int free, int wall) {
  return static_cast<std::uint8_t>(wall * (kShades + 1) + free);
}

draw::Rgb mixed(const draw::Rgb& a, const draw::Rgb& b, int part) {
  const auto channel = [&](int from, int to) { return static_cast<std::uint8_t>(from + (to - from) * part / kShades); };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

std::vector<draw::Rgb> palette() {
  std::vector<draw::Rgb> colours;
  for (int wall = 0; wall <= kShades; ++wall) {
    for (int free = 0; free <= kShades; ++free) colours.push_back(mixed(mixed(kUnknown, kFree, free), kWall, wall));
  }
  return colours;
}

/// The shade of a square of cells. A wall through it that is one cell wide makes it black; single occupied cells make
/// it grey.
std::uint8_t shadeOf(const ScanGrid& grid, int column, int row, int block) {
  const int end_column = std::min(column + block, grid.columns), end_row = std::min(row + block, grid.rows);
  int free = 0, walls = 0;
  for (int y = row; y < end_row; ++y) {
    for (int x = column; x < end_column; ++x) {
      const Cell cell = grid.at(x, y);
      free += cell != Cell::unknown;
      walls += cell == Cell::occupied;
    }
  }
  return shade((kShades * free + block * block - 1) / (block * block), std::min(kShades, kShades * walls / block));
}

/// Draws `block` cells per pixel, and each pixel `zoom` times as large.
GridPicture draw(const ScanGrid& grid, int block, int zoom) {
  GridPicture picture;
  picture.metres_per_pixel = grid.resolution * block / zoom;
  picture.min_x = grid.min_x;
  const int columns = (grid.columns + block - 1) / block, rows = (grid.rows + block - 1) / block;
  picture.max_y = grid.min_y + rows * block * grid.resolution;
  draw::PaletteImage& image = picture.image;
  image.width = columns * zoom;
  image.height = rows * zoom;
  image.palette = palette();
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  constexpr std::uint8_t kShadeOfCell[] = {shade(0, 0), shade(kShades, 0),
                                           shade(kShades, kShades)};  // in the order of Cell
  for (int row = 0; row < rows; ++row) {
    auto line = image.pixels.begin() + static_cast<std::ptrdiff_t>(rows - 1 - row) * zoom * image.width;
    for (int column = 0; column < columns; ++column) {
      const std::uint8_t value = block == 1 ? kShadeOfCell[static_cast<int>(grid.at(column, row))]
                                            : shadeOf(grid, column * block, row * block, block);
      std::fill_n(line + column * zoom, zoom, value);
    }
    for (int copy = 1; copy < zoom; ++copy) std::copy_n(line, image.width, line + copy * image.width);
  }
  return picture;
}

/// First and last index that remain when `share` of the sum of `counts` is cut off at each end. An end is only cut if
/// that shortens the range by more than a tenth of what remains.
std::pair<int, int> trimmed(const std::vector<double>& counts, double share) {
  const double most = share * std::accumulate(counts.begin(), counts.end(), 0.0);
  int lowest = 0, highest = static_cast<int>(counts.size()) - 1;
  for (; lowest < highest && counts[lowest] == 0; ++lowest) continue;
  for (; highest > lowest && counts[highest] == 0; --highest) continue;
  int first = lowest, last = highest;
  for (double cut = 0; first < last && cut + counts[first] <= most; ++first) cut += counts[first];
  for (double cut = 0; last > first && cut + counts[last] <= most; --last) cut += counts[last];
  const int least = (last - first) / 10;
  return {first - lowest > least ? first : lowest, highest - last > least ? last : highest};
}

}  // namespace

GridPicture drawGrid(const ScanGrid& grid) {
  return draw(grid, 1, 1);
}

GridPicture drawGridToSize(const ScanGrid& grid, int side) {
  const int longer = std::max(grid.columns, grid.rows);
  const auto times = [](int a, int b) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(a) / b)));
  };
  const int zoom = times(side, longer);
  return draw(grid, times(longer, side), zoom);
}

ScanGrid focused(const ScanGrid& grid, const std::vector<mrpt::math::TPoint3D>& places) {
  constexpr double kCut = 0.005;
  std::vector<double> columns(static_cast<std::size_t>(grid.columns)), rows(static_cast<std::size_t>(grid.rows));
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (grid.at(column, row) == Cell::unknown) continue;
      ++columns[column];
      ++rows[row];
    }
  }
  auto [left, right] = trimmed(columns, kCut);
  auto [low, high] = trimmed(rows, kCut);
  for (const auto& place : places) {
    const int column = static_cast<int>(std::clamp<double>((place.x - grid.min_x) / grid.resolution, 0, grid.columns));
    const int row = static_cast<int>(std::clamp<double>((place.y - grid.min_y) / grid.resolution, 0, grid.rows));
    left = std::min(left, column), right = std::max(right, column);
    low = std::min(low, row), high = std::max(high, row);
  }
  const int longer = std::max(right - left, high - low);
  const int margin = static_cast<int>(std::ceil(0.03 * longer)), below = static_cast<int>(std::ceil(0.06 * longer));
  left -= margin, right += margin;
  low -= below, high += margin;
  ScanGrid part;
  part.columns = right - left + 1;
  part.rows = high - low + 1;
  part.resolution = grid.resolution;
  part.min_x = grid.min_x + left * grid.resolution;
  part.min_y = grid.min_y + low * grid.resolution;
  part.cells.assign(static_cast<std::size_t>(part.columns) * part.rows, Cell::unknown);
  const int first = std::max(left, 0), end = std::min(right + 1, grid.columns);
  for (int row = std::max(low, 0); row < std::min(high + 1, grid.rows); ++row) {
    const auto line = grid.cells.begin() + static_cast<std::ptrdiff_t>(row) * grid.columns;
    std::copy(line + first, line + end,
              part.cells.begin() + static_cast<std::ptrdiff_t>(row - low) * part.columns + (first - left));
  }
  return part;
}

}  // namespace omnimapper::derived

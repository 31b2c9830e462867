#include "GridPicture.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

const std::vector<Rgb> kColours{
    {226, 231, 237}, {255, 255, 255}, {24, 33, 47}};  // as Cell counts: unknown, free, occupied

std::uint8_t strongestOf(const ScanGrid& grid, int column, int row, int block) {
  const int end_column = std::min(column + block, grid.columns), end_row = std::min(row + block, grid.rows);
  Cell strongest = Cell::unknown;
  for (int y = row; y < end_row; ++y) {
    for (int x = column; x < end_column; ++x) strongest = std::max(strongest, grid.at(x, y));
  }
  return static_cast<std::uint8_t>(strongest);
}

/// `block` cells to a pixel, then each pixel `zoom` times as large.
GridPicture draw(const ScanGrid& grid, int block, int zoom) {
  GridPicture picture;
  picture.metres_per_pixel = grid.resolution * block / zoom;
  picture.min_x = grid.min_x;
  const int columns = (grid.columns + block - 1) / block, rows = (grid.rows + block - 1) / block;
  picture.max_y = grid.min_y + rows * block * grid.resolution;
  PaletteImage& image = picture.image;
  image.width = columns * zoom;
  image.height = rows * zoom;
  image.palette = kColours;
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  for (int row = 0; row < rows; ++row) {
    auto line = image.pixels.begin() + static_cast<std::ptrdiff_t>(rows - 1 - row) * zoom * image.width;
    for (int column = 0; column < columns; ++column) {
      const std::uint8_t value = block == 1 ? static_cast<std::uint8_t>(grid.at(column, row))
                                            : strongestOf(grid, column * block, row * block, block);
      std::fill_n(line + column * zoom, zoom, value);
    }
    for (int copy = 1; copy < zoom; ++copy) std::copy_n(line, image.width, line + copy * image.width);
  }
  return picture;
}

}  // namespace

GridPicture drawGrid(const ScanGrid& grid) {
  return draw(grid, 1, 1);
}

GridPicture drawGridToSize(const ScanGrid& grid, int side) {
  const int longer = std::max(grid.columns, grid.rows);
  if (longer >= side) return draw(grid, static_cast<int>(std::lround(static_cast<double>(longer) / side)), 1);
  return draw(grid, 1, std::max(1, static_cast<int>(std::lround(static_cast<double>(side) / longer))));
}

}  // namespace omnimapper::plugins

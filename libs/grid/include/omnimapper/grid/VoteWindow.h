#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace omnimapper::grid {

/// A rectangle of cells, by index: cell (i, j) spans i to i + 1 and j to j + 1 times the side of a cell.
struct CellBox {
  std::int64_t min_x = 0, min_y = 0, max_x = -1, max_y = -1;  ///< inclusive
};

/// The votes of one scan for the cells of a rectangle: log-odds for each, 0 where there is no vote. The rectangle
/// consists of whole tiles, so that it can be added to a grid tile by tile.
class VoteWindow {
 public:
  static constexpr int kTileSide = 64;  ///< [cells]

  /// Moves the window so that it contains `box`. The window must be empty: new, or emptied by takeRows().
  void moveTo(const CellBox& box);
  /// Index of the cell in the window's lower left corner.
  std::int64_t minX() const { return tile_x_ * kTileSide; }
  std::int64_t minY() const { return tile_y_ * kTileSide; }

  /// Sets the vote of the cells on the line between two places in the window [cells, from the window's corner], and so
  /// replaces earlier votes for these cells. The line consists of the cells of both ends and, in each column, of the
  /// cell in which the line crosses the middle of the column. For a steep line, rows take the place of columns.
  void voteLine(double x0, double y0, double x1, double y1, int vote);
  void voteCell(double x, double y, int vote) {
    const auto column = static_cast<std::ptrdiff_t>(x), row = static_cast<std::ptrdiff_t>(y);
    votes_[row * stride() + column] = static_cast<std::int8_t>(vote);
    touched_[(row / kTileSide) * columns_ + column / kTileSide] = 1;
  }

  /// Calls `use(tile_x, tile_y, row, votes)` for each row of kTileSide votes that are not all 0, tile by tile, and
  /// empties the window.
  template <class Use>
  void takeRows(const Use& use) {
    for (int tile = 0; tile < columns_ * rows_; ++tile) {
      if (!touched_[tile]) continue;
      touched_[tile] = 0;
      std::int8_t* row = votes_.data() + tile / columns_ * kTileSide * stride() + tile % columns_ * kTileSide;
      for (int y = 0; y < kTileSide; ++y, row += stride()) {
        if (isEmpty(row)) continue;
        use(tile_x_ + tile % columns_, tile_y_ + tile / columns_, y, row);
        std::memset(row, 0, kTileSide);
      }
    }
  }

 private:
  template <bool is_steep>
  void voteLineAlong(double u0, double v0, double u1, double v1, std::int8_t vote);
  std::ptrdiff_t stride() const { return std::ptrdiff_t{columns_} * kTileSide; }
  static bool isEmpty(const std::int8_t* row) {
    std::uint64_t words[kTileSide / 8], any = 0;
    std::memcpy(words, row, sizeof words);
    for (const std::uint64_t word : words) any |= word;
    return any == 0;
  }

  std::int64_t tile_x_ = 0, tile_y_ = 0;  // of the tile in the lower left corner
  int columns_ = 0, rows_ = 0;            // in tiles
  std::vector<std::int8_t> votes_;        // row by row
  std::vector<std::uint8_t> touched_;     // a flag for each tile: it may have votes
};

}  // namespace omnimapper::grid

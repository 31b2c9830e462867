#pragma once

#include <omnimapper/grid/VoteWindow.h>

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace omnimapper::grid {

/// Log-odds of occupancy: for each cell, the sum of the votes of scans. Votes are whole numbers, so that they can be
/// removed again exactly, in any order. The cells are stored in tiles, and only where scans have voted.
class OccupancyGrid {
 public:
  static constexpr int kTileSide = VoteWindow::kTileSide;
  /// A square of cells.
  class Tile {
   public:
    std::int32_t at(int column, int row) const {
      const std::size_t cell = static_cast<std::size_t>(row) * kTileSide + column;
      return low_[cell] + (high_.empty() ? 0 : high_[cell]);
    }

   private:
    friend class OccupancyGrid;
    void countChange();

    std::array<std::int16_t, kTileSide * kTileSide> low_{};  // row by row; the sums, minus those in high_
    std::vector<std::int32_t> high_;                         // empty until sums could outgrow 16 bits
    int changes_ = 0;                                        // number of changes since low_ was last moved to high_
  };
  struct TileIndex {
    std::int64_t x = 0, y = 0;
    bool operator==(const TileIndex& other) const { return x == other.x && y == other.y; }
  };
  struct TileHash {
    std::size_t operator()(const TileIndex& index) const {
      return static_cast<std::size_t>(index.x) * 0x9E3779B97F4A7C15U ^ static_cast<std::size_t>(index.y);
    }
  };
  using Tiles = std::unordered_map<TileIndex, std::unique_ptr<Tile>, TileHash>;

  /// Adds the votes. This function and takeOut() empty the window.
  void add(VoteWindow& votes);
  /// Undoes one add() of the same votes.
  void takeOut(VoteWindow& votes);
  void clear() { tiles_.clear(); }

  const Tiles& tiles() const { return tiles_; }
  /// Box around the cells that are not 0; empty (max below min) if there is none.
  CellBox bounds() const;

 private:
  template <class Change>
  void change(VoteWindow& votes, const Change& change);

  Tiles tiles_;
};

}  // namespace omnimapper::grid

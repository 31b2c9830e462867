#include <omnimapper/grid/OccupancyGrid.h>

#include <algorithm>
#include <limits>

namespace omnimapper::grid {

namespace {

constexpr int kCells = OccupancyGrid::kTileSide * OccupancyGrid::kTileSide;
/// Number of votes of any size that surely fit into the 16 bits of a cell.
constexpr int kMostChanges = std::numeric_limits<std::int16_t>::max() / -std::numeric_limits<std::int8_t>::min();

}  // namespace

// Sums are kept in 16 bits, because half the bytes are half the work and few cells ever need more. They move to 32 bits
// before they can overflow.
void OccupancyGrid::Tile::countChange() {
  if (++changes_ < kMostChanges) return;
  changes_ = 1;
  if (high_.empty()) high_.resize(kCells, 0);
  for (int i = 0; i < kCells; ++i) high_[i] += low_[i];
  low_.fill(0);
}

template <class Change>
void OccupancyGrid::change(VoteWindow& votes, const Change& change) {
  TileIndex last;
  Tile* tile = nullptr;
  votes.takeRows([&](std::int64_t x, std::int64_t y, int row, const std::int8_t* row_votes) {
    if (!tile || !(last == TileIndex{x, y})) {
      last = {x, y};
      auto& slot = tiles_[last];
      if (!slot) slot = std::make_unique<Tile>();
      tile = slot.get();
      tile->countChange();
    }
    change(tile->low_.data() + row * kTileSide, row_votes);
  });
}

void OccupancyGrid::add(VoteWindow& votes) {
  change(votes, [](std::int16_t* cells, const std::int8_t* row) {
    for (int x = 0; x < kTileSide; ++x) cells[x] = static_cast<std::int16_t>(cells[x] + row[x]);
  });
}

void OccupancyGrid::takeOut(VoteWindow& votes) {
  change(votes, [](std::int16_t* cells, const std::int8_t* row) {
    for (int x = 0; x < kTileSide; ++x) cells[x] = static_cast<std::int16_t>(cells[x] - row[x]);
  });
}

CellBox OccupancyGrid::bounds() const {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  CellBox box{kMost, kMost, -kMost, -kMost};
  for (const auto& [index, tile] : tiles_) {
    const std::int64_t left = index.x * kTileSide, low = index.y * kTileSide;
    const std::int64_t right = left + kTileSide - 1, high = low + kTileSide - 1;
    if (left >= box.min_x && right <= box.max_x && low >= box.min_y && high <= box.max_y) continue;
    for (int y = 0; y < kTileSide; ++y) {
      int first = 0, last = kTileSide - 1;
      while (first <= last && tile->at(first, y) == 0) ++first;
      if (first > last) continue;
      while (tile->at(last, y) == 0) --last;
      box.min_x = std::min(box.min_x, left + first), box.max_x = std::max(box.max_x, left + last);
      box.min_y = std::min(box.min_y, low + y), box.max_y = std::max(box.max_y, low + y);
    }
  }
  return box;
}

}  // namespace omnimapper::grid

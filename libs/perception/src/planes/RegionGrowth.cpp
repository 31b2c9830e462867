#include <algorithm>
#include <array>

#include "CellRegions.h"

namespace omnimapper::perception::planes {

namespace {

// Blocks of cells that regions grow from. The largest come first, so that regions start with a good plane.
struct Block {
  int columns, rows;
  double chi2;  // 99.9 % quantile with 3 degrees of freedom for each cell but one
};
constexpr Block kBlocks[] = {{3, 3, 51.18}, {2, 2, 27.88}, {2, 1, 16.27}, {1, 2, 16.27}};
constexpr double kChi2Cell = 16.27;

struct Seed {
  double excess;  // squares beyond those of the cells' own planes, per pixel
  int column, row;
};

class Growth {
 public:
  Growth(const CellGrid& grid, const camera::DepthNoise& noise) : grid_(grid), noise_(noise) {
    result_.of_cell.assign(grid.cells.size(), kNoRegion);
  }

  // Grows regions from the blocks whose cells are all flat and in no region yet.
  void growFrom(const Block& block) {
    std::vector<Seed> seeds;
    for (int row = 0; row + block.rows <= grid_.rows; ++row) {
      for (int column = 0; column + block.columns <= grid_.columns; ++column) addSeed(column, row, block, seeds);
    }
    std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
      return a.excess != b.excess ? a.excess < b.excess : a.row != b.row ? a.row < b.row : a.column < b.column;
    });
    for (const Seed& seed : seeds) {
      if (isFree(seed.column, seed.row, block)) grow(seed, block);
    }
  }

  CellRegions take() { return std::move(result_); }

 private:
  bool isFree(int column, int row, const Block& block) const {
    for (int y = row; y < row + block.rows; ++y) {
      for (int x = column; x < column + block.columns; ++x) {
        if (!grid_.at(x, y).flat || regionOf(x, y) != kNoRegion) return false;
      }
    }
    return true;
  }

  void addSeed(int column, int row, const Block& block, std::vector<Seed>& seeds) const {
    if (!isFree(column, row, block)) return;
    PlaneMoments sum;
    double squares = 0;
    for (int y = row; y < row + block.rows; ++y) {
      for (int x = column; x < column + block.columns; ++x) {
        sum += grid_.at(x, y).moments;
        squares += grid_.at(x, y).squares;
      }
    }
    const double excess = sum.fit().squares - squares;
    if (excess > block.chi2 * noise_.meanVariance() + sum.n * noise_.distortion * noise_.distortion) return;
    seeds.push_back({excess / sum.n, column, row});
  }

  void grow(const Seed& seed, const Block& block) {
    const int index = static_cast<int>(result_.regions.size());
    CellRegions::Region region;
    queue_.clear();
    for (int y = seed.row; y < seed.row + block.rows; ++y) {
      for (int x = seed.column; x < seed.column + block.columns; ++x) join(x, y, index, region);
    }
    region.plane = region.moments.fit().plane;
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const auto [column, row] = queue_[next];
      if (column > 0) tryToJoin(column - 1, row, index, region);
      if (column + 1 < grid_.columns) tryToJoin(column + 1, row, index, region);
      if (row > 0) tryToJoin(column, row - 1, index, region);
      if (row + 1 < grid_.rows) tryToJoin(column, row + 1, index, region);
    }
    result_.regions.push_back(region);
  }

  void tryToJoin(int column, int row, int index, CellRegions::Region& region) {
    const Cell& cell = grid_.at(column, row);
    if (!cell.flat || regionOf(column, row) != kNoRegion) return;
    if (cell.moments.squaresFrom(region.plane) - cell.squares >
        excessAllowed(noise_, cell.moments.n, noise_.distortion))
      return;
    join(column, row, index, region);
    region.plane = region.moments.fit().plane;
  }

  void join(int column, int row, int index, CellRegions::Region& region) {
    region.moments += grid_.at(column, row).moments;
    result_.of_cell[static_cast<std::size_t>(grid_.index(column, row))] = index;
    queue_.push_back({column, row});
  }

  int regionOf(int column, int row) const {
    return result_.of_cell[static_cast<std::size_t>(grid_.index(column, row))];
  }

  const CellGrid& grid_;
  const camera::DepthNoise& noise_;
  CellRegions result_;
  std::vector<std::array<int, 2>> queue_;
};

}  // namespace

double excessAllowed(const camera::DepthNoise& noise, double n, double distortion) {
  return kChi2Cell * noise.meanVariance() + n * distortion * distortion;
}

CellRegions growRegions(const CellGrid& grid, const camera::DepthNoise& noise) {
  Growth growth(grid, noise);
  for (const Block& block : kBlocks) growth.growFrom(block);
  return growth.take();
}

}  // namespace omnimapper::perception::planes

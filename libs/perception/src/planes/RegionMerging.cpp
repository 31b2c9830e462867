#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "CellRegions.h"

namespace omnimapper::perception::planes {

namespace {

constexpr double kChi2 = 16.27;         // 99.9 %, 3 degrees of freedom
constexpr double kMostAstray = 1 / 3.;  // of a region's cells, off its plane: it is curved

// Where two regions meet: how many cells of one are explained by the plane of the other, of how many.
struct Meeting {
  int cells = 0, explained = 0;
};
using Meetings = std::map<std::pair<int, int>, Meeting>;

class Merging {
 public:
  Merging(const CellGrid& grid, const DepthNoise& noise, CellRegions& regions)
      : grid_(grid), noise_(noise), r_(regions) {}

  void mergeAll() {
    while (mergeBest()) {
    }
  }

  void dropCurved() {
    std::vector<int> cells(r_.regions.size()), astray(r_.regions.size());
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      if (r_.of_cell[i] == kNoRegion) continue;
      ++cells[static_cast<std::size_t>(r_.of_cell[i])];
      astray[static_cast<std::size_t>(r_.of_cell[i])] += !explains(r_.of_cell[i], grid_.cells[i]);
    }
    std::vector<int> renamed(r_.regions.size(), kNoRegion);
    std::vector<CellRegions::Region> kept;
    for (std::size_t i = 0; i < r_.regions.size(); ++i) {
      if (cells[i] == 0 || astray[i] > kMostAstray * cells[i]) continue;
      renamed[i] = static_cast<int>(kept.size());
      kept.push_back(r_.regions[i]);
    }
    r_.regions = std::move(kept);
    for (int& region : r_.of_cell) region = region == kNoRegion ? kNoRegion : renamed[static_cast<std::size_t>(region)];
  }

 private:
  const CellRegions::Region& region(int index) const { return r_.regions[static_cast<std::size_t>(index)]; }

  bool explains(int index, const Cell& cell) const {
    return cell.moments.squaresFrom(region(index).plane) - cell.squares <= excessAllowed(noise_, cell.moments.n);
  }

  Meetings meetings() const {
    Meetings met;
    for (int row = 0; row < grid_.rows; ++row) {
      for (int column = 0; column < grid_.columns; ++column) {
        // One cell between two regions is often at the border and belongs to neither.
        for (int step = 1; step <= 2; ++step) {
          if (column + step < grid_.columns) meet(grid_.index(column, row), grid_.index(column + step, row), met);
          if (row + step < grid_.rows) meet(grid_.index(column, row), grid_.index(column, row + step), met);
        }
      }
    }
    return met;
  }

  void meet(int cell_a, int cell_b, Meetings& met) const {
    const auto i = static_cast<std::size_t>(cell_a), j = static_cast<std::size_t>(cell_b);
    const int a = r_.of_cell[i], b = r_.of_cell[j];
    if (a == b || a == kNoRegion || b == kNoRegion) return;
    Meeting& meeting = met[std::minmax(a, b)];
    meeting.cells += 2;
    meeting.explained += explains(b, grid_.cells[i]) + explains(a, grid_.cells[j]);
  }

  // Squares that one plane for both leaves beyond those of two planes, in parts of what may be. Below 1: they are one.
  double misfit(int a, int b) const {
    const PlaneMoments &m = region(a).moments, &o = region(b).moments;
    PlaneMoments both = m;
    both += o;
    const double excess = both.fit().squares - m.fit().squares - o.fit().squares;
    const double shared = m.n * o.n / both.n, bend = 2 * noise_.bend;
    return excess / (kChi2 * noise_.meanVariance() + shared * bend * bend);
  }

  bool mergeBest() {
    double least = 1;
    std::pair<int, int> best{kNoRegion, kNoRegion};
    for (const auto& [pair, meeting] : meetings()) {
      if (2 * meeting.explained < meeting.cells) continue;
      const double found = misfit(pair.first, pair.second);
      if (found < least) {
        least = found;
        best = pair;
      }
    }
    if (best.first == kNoRegion) return false;
    auto& kept = r_.regions[static_cast<std::size_t>(best.first)];
    kept.moments += region(best.second).moments;
    kept.plane = kept.moments.fit().plane;
    std::replace(r_.of_cell.begin(), r_.of_cell.end(), best.second, best.first);
    return true;
  }

  const CellGrid& grid_;
  const DepthNoise& noise_;
  CellRegions& r_;
};

}  // namespace

CellRegions mergeRegions(const CellGrid& grid, const DepthNoise& noise, CellRegions grown) {
  Merging merging(grid, noise, grown);
  merging.mergeAll();
  merging.dropCurved();
  return grown;
}

}  // namespace omnimapper::perception::planes

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "CellRegions.h"

namespace omnimapper::perception::planes {

namespace {

constexpr double kChi2 = 16.27;         // 99.9 %, 3 degrees of freedom
constexpr double kStep = 0.03;          // [m] nearer than that two surfaces look like one
constexpr double kMostAstray = 1 / 3.;  // of a region's cells, off its plane: it is curved

// Two regions that meet: pairs of cells, one of each, and by how much one plane for both is worse than two; see
// misfit().
struct Meeting {
  std::vector<std::pair<int, int>> cells;
  double misfit = 0;
};

class Merging {
 public:
  Merging(const CellGrid& grid, const DepthNoise& noise, CellRegions& regions)
      : grid_(grid), noise_(noise), r_(regions) {}

  void mergeAll() {
    findMeetings();
    while (mergeBest()) {
    }
  }

  void dropCurved() {
    std::vector<int> cells(r_.regions.size()), astray(r_.regions.size());
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      if (r_.of_cell[i] == kNoRegion) continue;
      ++cells[static_cast<std::size_t>(r_.of_cell[i])];
      astray[static_cast<std::size_t>(r_.of_cell[i])] +=
          !explains(r_.of_cell[i], grid_.cells[i], bendOfTwo(grid_.cells[i]));
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

  bool explains(int index, const Cell& cell, double bend) const {
    return cell.moments.squaresFrom(region(index).plane) - cell.squares <= excessAllowed(noise_, cell.moments.n, bend);
  }

  // By how much a cell may be off the plane of pieces of one wall, in inverse depth [1/m]. The sensor may bend two
  // pieces away from each other, each by one bend. Where two bends are more than kStep, they could be two things, such
  // as a wall and a bookcase, and only one bend is allowed.
  double bendOfTwo(const Cell& cell) const {
    const double inverse = cell.moments.q / cell.moments.n;
    return std::clamp(kStep * inverse * inverse, noise_.bend, 2 * noise_.bend);
  }

  void findMeetings() {
    for (int row = 0; row < grid_.rows; ++row) {
      for (int column = 0; column < grid_.columns; ++column) {
        if (r_.of_cell[static_cast<std::size_t>(grid_.index(column, row))] == kNoRegion) continue;
        // One cell between two regions is often at the border and belongs to neither.
        for (int step = 1; step <= 2; ++step) {
          if (column + step < grid_.columns) meet(grid_.index(column, row), grid_.index(column + step, row));
          if (row + step < grid_.rows) meet(grid_.index(column, row), grid_.index(column, row + step));
        }
      }
    }
    for (auto& [pair, meeting] : meetings_) meeting.misfit = misfit(pair.first, pair.second);
  }

  void meet(int cell_a, int cell_b) {
    const int a = r_.of_cell[static_cast<std::size_t>(cell_a)], b = r_.of_cell[static_cast<std::size_t>(cell_b)];
    if (a != b && b != kNoRegion) meetings_[std::minmax(a, b)].cells.emplace_back(cell_a, cell_b);
  }

  // Whether the plane of one region explains at least half of the cells of the other where they meet.
  bool continues(const Meeting& meeting) const {
    std::size_t explained = 0;
    for (const auto& [i, j] : meeting.cells) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      explained += explains(r_.of_cell[b], grid_.cells[a], bendOfTwo(grid_.cells[a])) +
                   explains(r_.of_cell[a], grid_.cells[b], bendOfTwo(grid_.cells[b]));
    }
    return explained >= meeting.cells.size();
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
    for (const auto& [pair, meeting] : meetings_) {
      if (meeting.misfit < least && continues(meeting)) {
        least = meeting.misfit;
        best = pair;
      }
    }
    if (best.first == kNoRegion) return false;
    merge(best.first, best.second);
    return true;
  }

  void merge(int kept, int gone) {
    auto& region_kept = r_.regions[static_cast<std::size_t>(kept)];
    region_kept.moments += region(gone).moments;
    region_kept.plane = region_kept.moments.fit().plane;
    std::replace(r_.of_cell.begin(), r_.of_cell.end(), gone, kept);
    meetings_.erase({kept, gone});
    for (auto i = meetings_.begin(); i != meetings_.end();) {
      const auto [a, b] = i->first;
      if (a != gone && b != gone) {
        ++i;
        continue;
      }
      auto& cells = meetings_[std::minmax(kept, a == gone ? b : a)].cells;
      cells.insert(cells.end(), i->second.cells.begin(), i->second.cells.end());
      i = meetings_.erase(i);
    }
    for (auto& [pair, meeting] : meetings_) {
      if (pair.first == kept || pair.second == kept) meeting.misfit = misfit(pair.first, pair.second);
    }
  }

  const CellGrid& grid_;
  const DepthNoise& noise_;
  CellRegions& r_;
  std::map<std::pair<int, int>, Meeting> meetings_;  // by the lower and the higher index of the two
};

}  // namespace

CellRegions mergeRegions(const CellGrid& grid, const DepthNoise& noise, CellRegions grown) {
  Merging merging(grid, noise, grown);
  merging.mergeAll();
  merging.dropCurved();
  return grown;
}

}  // namespace omnimapper::perception::planes

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "CellRegions.h"

namespace omnimapper::perception::planes {

namespace {

constexpr double kChi2 = 16.27;               // 99.9 %, 3 degrees of freedom
constexpr double kStep = 0.03;                // [m] surfaces closer together than this look like one
constexpr double kMaxOffPlaneShare = 1 / 3.;  // a region with a larger share of cells off its plane is curved

// Two adjacent regions: pairs of cells, one of each region, and how much worse one plane for both is than two planes;
// see misfit().
struct Adjacency {
  std::vector<std::pair<int, int>> cells;
  double misfit = 0;
};

class Merging {
 public:
  Merging(const CellGrid& grid, const camera::DepthNoise& noise, CellRegions& regions)
      : grid_(grid), noise_(noise), r_(regions) {}

  void mergeAll() {
    findAdjacencies();
    while (mergeBest()) {
    }
  }

  void dropCurved() {
    std::vector<int> cells(r_.regions.size()), off_plane(r_.regions.size());
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      if (r_.of_cell[i] == kNoRegion) continue;
      ++cells[static_cast<std::size_t>(r_.of_cell[i])];
      off_plane[static_cast<std::size_t>(r_.of_cell[i])] +=
          !explains(r_.of_cell[i], grid_.cells[i], distortionOfTwo(grid_.cells[i]));
    }
    std::vector<int> renamed(r_.regions.size(), kNoRegion);
    std::vector<CellRegions::Region> kept;
    for (std::size_t i = 0; i < r_.regions.size(); ++i) {
      if (cells[i] == 0 || off_plane[i] > kMaxOffPlaneShare * cells[i]) continue;
      renamed[i] = static_cast<int>(kept.size());
      kept.push_back(r_.regions[i]);
    }
    r_.regions = std::move(kept);
    for (int& region : r_.of_cell) region = region == kNoRegion ? kNoRegion : renamed[static_cast<std::size_t>(region)];
  }

 private:
  const CellRegions::Region& region(int index) const { return r_.regions[static_cast<std::size_t>(index)]; }

  bool explains(int index, const Cell& cell, double distortion) const {
    return cell.moments.squaresFrom(region(index).plane) - cell.squares <=
           excessAllowed(noise_, cell.moments.n, distortion);
  }

  // How far a cell may be from the plane of another piece of the same wall, in inverse depth [1/m]. Systematic
  // distortion may move each of two pieces, so twice the distortion is allowed, but no more than kStep, beyond which
  // they could be two surfaces, such as a wall and a bookcase. The distortion itself is always allowed.
  double distortionOfTwo(const Cell& cell) const {
    const double inverse = cell.moments.q / cell.moments.n;
    return std::clamp(kStep * inverse * inverse, noise_.distortion, 2 * noise_.distortion);
  }

  void findAdjacencies() {
    for (int row = 0; row < grid_.rows; ++row) {
      for (int column = 0; column < grid_.columns; ++column) {
        if (r_.of_cell[static_cast<std::size_t>(grid_.index(column, row))] == kNoRegion) continue;
        // A single cell between two regions is often at the border and belongs to neither, so its neighbours are
        // paired.
        for (int step = 1; step <= 2; ++step) {
          if (column + step < grid_.columns) addPair(grid_.index(column, row), grid_.index(column + step, row));
          if (row + step < grid_.rows) addPair(grid_.index(column, row), grid_.index(column, row + step));
        }
      }
    }
    for (auto& [pair, adjacency] : adjacencies_) adjacency.misfit = misfit(pair.first, pair.second);
  }

  void addPair(int cell_a, int cell_b) {
    const int a = r_.of_cell[static_cast<std::size_t>(cell_a)], b = r_.of_cell[static_cast<std::size_t>(cell_b)];
    if (a != b && b != kNoRegion) adjacencies_[std::minmax(a, b)].cells.emplace_back(cell_a, cell_b);
  }

  // Whether the plane of one region explains at least half of the cells of the other where they meet.
  bool continues(const Adjacency& adjacency) const {
    std::size_t explained = 0;
    for (const auto& [i, j] : adjacency.cells) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      explained += explains(r_.of_cell[b], grid_.cells[a], distortionOfTwo(grid_.cells[a])) +
                   explains(r_.of_cell[a], grid_.cells[b], distortionOfTwo(grid_.cells[b]));
    }
    return explained >= adjacency.cells.size();
  }

  // Sum of squares that one plane leaves beyond that of two planes, divided by what noise and distortion allow. Below
  // 1, the regions are one plane.
  double misfit(int a, int b) const {
    const PlaneMoments &m = region(a).moments, &o = region(b).moments;
    PlaneMoments both = m;
    both += o;
    const double excess = both.fit().squares - m.fit().squares - o.fit().squares;
    const double shared = m.n * o.n / both.n, distortion = 2 * noise_.distortion;
    return excess / (kChi2 * noise_.meanVariance() + shared * distortion * distortion);
  }

  bool mergeBest() {
    double least = 1;
    std::pair<int, int> best{kNoRegion, kNoRegion};
    for (const auto& [pair, adjacency] : adjacencies_) {
      if (adjacency.misfit < least && continues(adjacency)) {
        least = adjacency.misfit;
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
    adjacencies_.erase({kept, gone});
    for (auto i = adjacencies_.begin(); i != adjacencies_.end();) {
      const auto [a, b] = i->first;
      if (a != gone && b != gone) {
        ++i;
        continue;
      }
      auto& cells = adjacencies_[std::minmax(kept, a == gone ? b : a)].cells;
      cells.insert(cells.end(), i->second.cells.begin(), i->second.cells.end());
      i = adjacencies_.erase(i);
    }
    for (auto& [pair, adjacency] : adjacencies_) {
      if (pair.first == kept || pair.second == kept) adjacency.misfit = misfit(pair.first, pair.second);
    }
  }

  const CellGrid& grid_;
  const camera::DepthNoise& noise_;
  CellRegions& r_;
  std::map<std::pair<int, int>, Adjacency> adjacencies_;  // keyed by the lower and the higher index
};

}  // namespace

CellRegions mergeRegions(const CellGrid& grid, const camera::DepthNoise& noise, CellRegions grown) {
  Merging merging(grid, noise, grown);
  merging.mergeAll();
  merging.dropCurved();
  return grown;
}

}  // namespace omnimapper::perception::planes

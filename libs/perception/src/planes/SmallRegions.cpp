#include "SmallRegions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "TileLabelling.h"

namespace omnimapper::perception::planes {

namespace {

constexpr std::size_t kFewCells = 8;
constexpr double kExplainedShare = 0.7;
constexpr double kRegionSigmas = 3;

class SmallRegions {
 public:
  SmallRegions(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
               const CellGrid& grid, CellRegions& regions)
      : inverse_(inverse),
        camera_(camera),
        tolerance_(static_cast<float>(kRegionSigmas * std::sqrt(noise.pixelVariance()))),
        grid_(grid),
        r_(regions),
        cells_(regions.regions.size()),
        labels_(static_cast<std::size_t>(inverse.stride) * kCell) {
    for (std::size_t i = 0; i < r_.of_cell.size(); ++i) {
      if (r_.of_cell[i] != kNoRegion) cells_[static_cast<std::size_t>(r_.of_cell[i])].push_back(static_cast<int>(i));
    }
  }

  void drop() {
    std::vector<std::size_t> small;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (!cells_[i].empty() && cells_[i].size() <= kFewCells) small.push_back(i);
    }
    std::stable_sort(small.begin(), small.end(),
                     [&](std::size_t a, std::size_t b) { return cells_[a].size() < cells_[b].size(); });
    for (const std::size_t region : small) {
      if (!isExplained(region)) continue;
      for (const int cell : cells_[region]) r_.of_cell[static_cast<std::size_t>(cell)] = kNoRegion;
    }
  }

 private:
  bool isExplained(std::size_t region) {
    double explained = 0, measured = 0;
    for (const int cell : cells_[region]) {
      explained += explainedPixels(region, cell);
      measured += grid_.cells[static_cast<std::size_t>(cell)].moments.n;
    }
    return explained >= kExplainedShare * measured;
  }

  // Number of the cell's pixels that lie on planes of larger regions up to two cells away.
  int explainedPixels(std::size_t region, int cell) {
    const int column = cell % grid_.columns, row = cell / grid_.columns;
    TileCandidates tile;
    std::size_t used[kMostCandidates];
    for (int y = std::max(0, row - 2); y <= std::min(grid_.rows - 1, row + 2); ++y) {
      for (int x = std::max(0, column - 2); x <= std::min(grid_.columns - 1, column + 2); ++x) {
        const int other = r_.of_cell[static_cast<std::size_t>(grid_.index(x, y))];
        if (other == kNoRegion || tile.count == kMostCandidates) continue;
        const auto o = static_cast<std::size_t>(other);
        if (cells_[o].size() <= cells_[region].size()) continue;
        if (std::find(used, used + tile.count, o) == used + tile.count) addCandidate(o, column, row, used, tile);
      }
    }
    if (tile.count == 0) return 0;
    labelTile(inverse_.at(column * kCell, row * kCell), inverse_.stride, tile, tolerance_, labels_.data());
    int pixels = 0;
    for (int y = 0; y < kCell; ++y) {
      const auto begin = labels_.begin() + static_cast<std::ptrdiff_t>(y) * inverse_.stride;
      pixels += kCell - static_cast<int>(std::count(begin, begin + kCell, 0));
    }
    return pixels;
  }

  void addCandidate(std::size_t region, int column, int row, std::size_t* used, TileCandidates& tile) const {
    const ImagePlane& plane = r_.regions[region].plane;
    const int k = tile.count++;
    used[k] = region;
    tile.a[k] = static_cast<float>(plane.a);
    tile.b[k] = static_cast<float>(plane.b);
    tile.c[k] = static_cast<float>(plane.at(column * kCell - camera_.cx, row * kCell - camera_.cy));
    tile.label[k] = 1;
    std::fill(tile.nearer_wins[k], tile.nearer_wins[k] + kMostCandidates, 0.F);
    for (int j = 0; j < k; ++j) tile.nearer_wins[j][k] = 0;
  }

  const InverseDepth& inverse_;
  const camera::Pinhole& camera_;
  float tolerance_;
  const CellGrid& grid_;
  CellRegions& r_;
  std::vector<std::vector<int>> cells_;  // cell indices of each region
  std::vector<std::uint16_t> labels_;
};

}  // namespace

CellRegions dropExplained(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
                          const CellGrid& grid, CellRegions regions) {
  SmallRegions(inverse, camera, noise, grid, regions).drop();
  return regions;
}

}  // namespace omnimapper::perception::planes

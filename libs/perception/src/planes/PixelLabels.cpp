#include "PixelLabels.h"

#include <algorithm>
#include <cmath>

#include "TileLabelling.h"

namespace omnimapper::perception::planes {

namespace {

// Tolerances in standard deviations of a pixel. Inside a region no other plane competes, so the tolerance is larger
// there and noisy pixels leave no holes.
constexpr double kBorderSigmas = 3;
constexpr double kInsideSigmas = 4.5;
// A cell without a region passes a neighbour's plane on to the next cells if at least this many pixels lie on it.
constexpr int kEnoughToPassOn = 3 * kCell * kCell / 10;

class PixelLabelling {
 public:
  PixelLabelling(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
                 const CellGrid& grid, const CellRegions& regions)
      : inverse_(inverse), camera_(camera), grid_(grid), regions_(regions), candidates_(grid.cells.size()) {
    const double sigma = std::sqrt(noise.pixelVariance() + noise.distortion * noise.distortion);
    border_tolerance_ = static_cast<float>(kBorderSigmas * sigma);
    inside_tolerance_ = static_cast<float>(kInsideSigmas * sigma);
    labels_.stride = inverse.stride;
    labels_.rows = inverse.rows;
    labels_.values.resize(static_cast<std::size_t>(inverse.stride) * static_cast<std::size_t>(inverse.rows));
  }

  PixelLabels label() {
    for (int row = 0; row < grid_.rows; ++row) {
      for (int column = 0; column < grid_.columns; ++column) {
        gatherCandidates(column, row);
        if (candidatesOf(column, row).count > 0) labelCell(column, row);
      }
    }
    passOn();
    return std::move(labels_);
  }

 private:
  struct Candidates {
    int count = 0;
    int region[kMostCandidates];

    bool has(int r) const { return std::find(region, region + count, r) != region + count; }
    bool add(int r) {
      if (r == kNoRegion || count == kMostCandidates || has(r)) return false;
      region[count++] = r;
      return true;
    }
  };

  int regionOf(int column, int row) const {
    return regions_.of_cell[static_cast<std::size_t>(grid_.index(column, row))];
  }
  Candidates& candidatesOf(int column, int row) {
    return candidates_[static_cast<std::size_t>(grid_.index(column, row))];
  }

  template <class Visit>
  void around(int column, int row, int reach, const Visit& visit) const {
    for (int y = std::max(0, row - reach); y <= std::min(grid_.rows - 1, row + reach); ++y) {
      for (int x = std::max(0, column - reach); x <= std::min(grid_.columns - 1, column + reach); ++x) visit(x, y);
    }
  }

  void gatherCandidates(int column, int row) {
    Candidates& candidates = candidatesOf(column, row);
    candidates.add(regionOf(column, row));
    around(column, row, 1, [&](int x, int y) { candidates.add(regionOf(x, y)); });
  }

  double u(int column) const { return column * kCell - camera_.cx; }
  double v(int row) const { return row * kCell - camera_.cy; }

  // Decides how two planes share the pixels that fit both, for TileCandidates::nearer_wins: 1 if each plane is nearer
  // to
  // the sensor over its own cells, -1 if each is farther, 0 otherwise.
  float nearerWins(int column, int row, int other, int region) const {
    const ImagePlane &p = regions_.regions[static_cast<std::size_t>(region)].plane,
                     &o = regions_.regions[static_cast<std::size_t>(other)].plane;
    const double half = 0.5 * kCell;
    double ahead_on_own = 0, ahead_on_other = 0;
    around(column, row, 2, [&](int x, int y) {
      const int here = regionOf(x, y);
      if (here != region && here != other) return;
      const double ahead = p.at(u(x) + half, v(y) + half) - o.at(u(x) + half, v(y) + half);
      (here == region ? ahead_on_own : ahead_on_other) += ahead;
    });
    if (ahead_on_own > 0 && ahead_on_other < 0) return 1;
    if (ahead_on_own < 0 && ahead_on_other > 0) return -1;
    return 0;
  }

  void labelCell(int column, int row) {
    const Candidates& candidates = candidatesOf(column, row);
    TileCandidates tile;
    tile.count = candidates.count;
    bool inside = candidates.count == 1;
    for (int k = 0; k < candidates.count; ++k) {
      const ImagePlane& plane = regions_.regions[static_cast<std::size_t>(candidates.region[k])].plane;
      tile.a[k] = static_cast<float>(plane.a);
      tile.b[k] = static_cast<float>(plane.b);
      tile.c[k] = static_cast<float>(plane.at(u(column), v(row)));
      tile.label[k] = candidates.region[k] + 1;
      for (int j = 0; j < k; ++j) {
        tile.nearer_wins[j][k] = nearerWins(column, row, candidates.region[j], candidates.region[k]);
      }
    }
    if (inside) {
      around(column, row, 1, [&](int x, int y) { inside = inside && regionOf(x, y) != kNoRegion; });
    }
    labelTile(inverse_.at(column * kCell, row * kCell), inverse_.stride, tile,
              inside ? inside_tolerance_ : border_tolerance_, labelsAt(column, row));
  }

  std::uint16_t* labelsAt(int column, int row) {
    return labels_.values.data() + static_cast<std::ptrdiff_t>(row) * kCell * labels_.stride + column * kCell;
  }

  int pixelsOf(int region, int column, int row) {
    const std::uint16_t* labels = labelsAt(column, row);
    int count = 0;
    for (int y = 0; y < kCell; ++y, labels += labels_.stride) {
      count += static_cast<int>(std::count(labels, labels + kCell, region + 1));
    }
    return count;
  }

  // Extends planes beyond the cells next to them, through cells that are too mixed to be flat.
  void passOn() {
    std::vector<int> queue;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (regions_.of_cell[i] == kNoRegion && candidates_[i].count > 0) queue.push_back(static_cast<int>(i));
    }
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const int column = queue[next] % grid_.columns, row = queue[next] / grid_.columns;
      const Candidates from = candidatesOf(column, row);
      for (int k = 0; k < from.count; ++k) {
        if (pixelsOf(from.region[k], column, row) < kEnoughToPassOn) continue;
        around(column, row, 1, [&](int x, int y) {
          if ((x != column && y != row) || !candidatesOf(x, y).add(from.region[k])) return;
          labelCell(x, y);
          if (regionOf(x, y) == kNoRegion) queue.push_back(grid_.index(x, y));
        });
      }
    }
  }

  const InverseDepth& inverse_;
  const camera::Pinhole& camera_;
  const CellGrid& grid_;
  const CellRegions& regions_;
  std::vector<Candidates> candidates_;
  float border_tolerance_, inside_tolerance_;
  PixelLabels labels_;
};

}  // namespace

PixelLabels labelPixels(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
                        const CellGrid& grid, const CellRegions& regions) {
  return PixelLabelling(inverse, camera, noise, grid, regions).label();
}

}  // namespace omnimapper::perception::planes

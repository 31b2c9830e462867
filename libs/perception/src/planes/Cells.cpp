#include "Cells.h"

#include "Lanes.h"

namespace omnimapper::perception::planes {

namespace {

// A cell with fewer measured pixels does not count as flat.
constexpr double kFewestPixels = 0.4 * kCell * kCell;
// Largest mean squared residual of a flat cell, as a multiple of a pixel's variance. It is generous because surfaces
// differ in noise and few pixels of a cell have independent errors.
constexpr double kFlatVariance = 2.5;
constexpr float kMiddle = 0.5F * (kCell - 1);

// Sums of each lane over its rows: weights n (1 for a measured pixel), values q, and their products with the row v and
// with themselves.
struct ColumnSums {
  Lanes n{}, nv{}, nvv{}, q{}, vq{}, qq{};
};

OMNIMAPPER_KERNEL_BODY void addRow(const Lanes& q, float origin, float v, ColumnSums& sums) {
  const LaneMask measured = q > 0.F;
  const Lanes weight = measured ? Lanes{} + 1.F : Lanes{};
  const Lanes value = measured ? q - origin : Lanes{};
  const Lanes weight_v = weight * v;
  sums.n += weight;
  sums.nv += weight_v;
  sums.nvv += weight_v * v;
  sums.q += value;
  sums.vq += value * v;
  sums.qq += value * value;
}

// Adds the sums of eight lanes, which are the columns from `first` on.
OMNIMAPPER_KERNEL_BODY void addColumns(const ColumnSums& sums, int first, PlaneMoments& m) {
  for (int i = 0; i < kLanes; ++i) {
    const double u = static_cast<float>(first + i) - kMiddle, n = sums.n[i], q = sums.q[i];
    m.n += n;
    m.u += u * n;
    m.uu += u * u * n;
    m.v += sums.nv[i];
    m.uv += u * sums.nv[i];
    m.vv += sums.nvv[i];
    m.q += q;
    m.uq += u * q;
    m.vq += sums.vq[i];
    m.qq += sums.qq[i];
  }
}

// Moments of one cell, with columns and rows counted from its centre and values from `origin`.
OMNIMAPPER_KERNEL_BODY void sumCellBody(const float* from, int stride, float origin, PlaneMoments& moments) {
  for (int first = 0; first < kCell; first += kLanes) {
    ColumnSums sums;
    for (int y = 0; y < kCell; ++y) {
      Lanes q;
      load(q, from + y * stride + first);
      addRow(q, origin, static_cast<float>(y) - kMiddle, sums);
    }
    addColumns(sums, first, moments);
  }
}

// A measured value of the cell, at its centre if possible: the origin that sums of squares in single precision need.
// Returns 0 if no pixel is measured.
OMNIMAPPER_KERNEL_BODY float originOf(const float* from, int stride) {
  const float middle = from[kCell / 2 * stride + kCell / 2];
  if (middle > 0) return middle;
  for (int y = 0; y < kCell; ++y) {
    for (int x = 0; x < kCell; ++x) {
      if (from[y * stride + x] > 0) return from[y * stride + x];
    }
  }
  return 0;
}

OMNIMAPPER_KERNEL_BODY void sumRowOfCellsBody(const float* from, int stride, int columns, float* origins,
                                              PlaneMoments* moments) {
  for (int i = 0; i < columns; ++i, from += kCell) {
    origins[i] = originOf(from, stride);
    moments[i] = PlaneMoments();
    if (origins[i] > 0) sumCellBody(from, stride, origins[i], moments[i]);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void sumRowOfCellsAvx2(const float* from, int stride, int columns, float* origins,
                                              PlaneMoments* moments) {
  sumRowOfCellsBody(from, stride, columns, origins, moments);
}
#endif

void sumRowOfCells(const float* from, int stride, int columns, float* origins, PlaneMoments* moments) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) return sumRowOfCellsAvx2(from, stride, columns, origins, moments);
#endif
  sumRowOfCellsBody(from, stride, columns, origins, moments);
}

}  // namespace

CellGrid fitCells(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise) {
  CellGrid grid;
  grid.columns = inverse.stride / kCell;
  grid.rows = inverse.rows / kCell;
  const auto columns = static_cast<std::size_t>(grid.columns);
  grid.cells.resize(columns * static_cast<std::size_t>(grid.rows));
  const double most_squares = kFlatVariance * noise.pixelVariance();
  std::vector<float> origins(columns);
  std::vector<PlaneMoments> moments(columns);
  for (int row = 0; row < grid.rows; ++row) {
    sumRowOfCells(inverse.at(0, row * kCell), inverse.stride, grid.columns, origins.data(), moments.data());
    for (std::size_t i = 0; i < columns; ++i) {
      Cell& cell = grid.cells[static_cast<std::size_t>(row) * columns + i];
      cell.squares = moments[i].fit().squares;
      cell.flat = moments[i].n >= kFewestPixels && cell.squares <= most_squares * moments[i].n;
      cell.moments = moments[i].shifted(static_cast<double>(i) * kCell + kMiddle - camera.cx,
                                        row * kCell + kMiddle - camera.cy, origins[i]);
    }
  }
  return grid;
}

}  // namespace omnimapper::perception::planes

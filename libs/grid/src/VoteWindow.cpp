#include <omnimapper/grid/VoteWindow.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::grid {

namespace {

constexpr int kTileBits = 6, kFractionBits = 32;
constexpr double kOne = 4294967296.0;  // in fixed point
static_assert(VoteWindow::kTileSide == 1 << kTileBits);

}  // namespace

void VoteWindow::moveTo(const CellBox& box) {
  tile_x_ = box.min_x >> kTileBits, tile_y_ = box.min_y >> kTileBits;
  columns_ = static_cast<int>((box.max_x >> kTileBits) - tile_x_ + 1);
  rows_ = static_cast<int>((box.max_y >> kTileBits) - tile_y_ + 1);
  const std::size_t tiles = static_cast<std::size_t>(columns_) * rows_;
  if (touched_.size() >= tiles) return;
  touched_.resize(tiles, 0);
  votes_.resize(tiles * kTileSide * kTileSide, 0);
}

void VoteWindow::voteLine(double x0, double y0, double x1, double y1, int vote) {
  const auto value = static_cast<std::int8_t>(vote);
  if (std::abs(y1 - y0) > std::abs(x1 - x0)) {
    y0 < y1 ? voteLineAlong<true>(y0, x0, y1, x1, value) : voteLineAlong<true>(y1, x1, y0, x0, value);
  } else {
    x0 < x1 ? voteLineAlong<false>(x0, y0, x1, y1, value) : voteLineAlong<false>(x1, y1, x0, y0, value);
  }
}

// u is the coordinate that the line runs along, and u0 <= u1.
template <bool is_steep>
void VoteWindow::voteLineAlong(double u0, double v0, double u1, double v1, std::int8_t vote) {
  is_steep ? voteCell(v0, u0, vote) : voteCell(u0, v0, vote);
  is_steep ? voteCell(v1, u1, vote) : voteCell(u1, v1, vote);
  const auto first = static_cast<std::ptrdiff_t>(u0) + 1, last = static_cast<std::ptrdiff_t>(u1);
  if (first >= last) return;
  const double slope = (v1 - v0) / (u1 - u0);
  const auto step = static_cast<std::int64_t>(slope * kOne);
  auto v = static_cast<std::int64_t>((v0 + slope * (static_cast<double>(first) + 0.5 - u0)) * kOne);
  const std::ptrdiff_t width = stride(), u_step = is_steep ? width : 1, v_step = is_steep ? 1 : width;
  const std::ptrdiff_t u_tiles = is_steep ? columns_ : 1, v_tiles = is_steep ? 1 : columns_;
  std::int8_t* line = votes_.data() + first * u_step;
  for (std::ptrdiff_t u = first; u < last;) {
    const std::ptrdiff_t tile = u >> kTileBits, end = std::min((tile + 1) << kTileBits, last);
    const std::int64_t begin_v = v;
    for (; u < end; ++u, line += u_step, v += step) line[(v >> kFractionBits) * v_step] = vote;
    std::uint8_t* touched = touched_.data() + tile * u_tiles;
    const auto tileOf = [](std::int64_t at) { return at >> (kFractionBits + kTileBits); };
    touched[tileOf(begin_v) * v_tiles] = 1;
    touched[tileOf(v - step) * v_tiles] = 1;
  }
}

}  // namespace omnimapper::grid

#include "InverseDepth.h"

#include <algorithm>

#include "Lanes.h"

namespace omnimapper::perception::planes {

namespace {

struct Bounds {
  float low, high;  // [unit of the depths]
  float unit;       // [1/m times the unit of the depths]
};

OMNIMAPPER_KERNEL_BODY void invertLanes(const Lanes& depth, const Bounds& bounds, float* to) {
  // NaN fails the comparisons, so it is not valid.
  const LaneMask valid = (depth >= bounds.low) & (depth <= bounds.high);
  const Lanes divisor = valid ? depth : Lanes{} + 1.F;
  store(valid ? bounds.unit / divisor : Lanes{}, to);
}

template <class Depth>
OMNIMAPPER_KERNEL_BODY void invertRowBody(const Depth* from, int n, const Bounds& bounds, float* to) {
  typedef Depth Source __attribute__((vector_size(kLanes * sizeof(Depth))));
  int x = 0;
  for (; x + kLanes <= n; x += kLanes) {
    Source source;
    std::memcpy(&source, from + x, sizeof(source));
    invertLanes(__builtin_convertvector(source, Lanes), bounds, to + x);
  }
  if (x == n) return;
  Depth last[kLanes] = {};
  std::copy(from + x, from + n, last);
  Source source;
  std::memcpy(&source, last, sizeof(source));
  float inverse[kLanes];
  invertLanes(__builtin_convertvector(source, Lanes), bounds, inverse);
  std::copy(inverse, inverse + (n - x), to + x);
}

#ifdef OMNIMAPPER_KERNEL_AVX2
template <class Depth>
OMNIMAPPER_KERNEL_AVX2 void invertRowAvx2(const Depth* from, int n, const Bounds& bounds, float* to) {
  invertRowBody(from, n, bounds, to);
}
#endif

template <class Depth>
void invertRow(const Depth* from, int n, const Bounds& bounds, float* to) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) return invertRowAvx2(from, n, bounds, to);
#endif
  invertRowBody(from, n, bounds, to);
}

int wholeCells(int pixels) {
  return (pixels + kCell - 1) / kCell * kCell;
}

}  // namespace

InverseDepth invert(const camera::DepthImage& image, double min_depth, double max_depth) {
  InverseDepth inverse;
  inverse.width = image.width();
  inverse.height = image.height();
  inverse.stride = wholeCells(image.width());
  inverse.rows = wholeCells(image.height());
  const auto stride = static_cast<std::size_t>(inverse.stride), width = static_cast<std::size_t>(inverse.width);
  // The values are not zeroed on allocation, which would cost as much as the rest of this function.
  const std::size_t pixels = stride * static_cast<std::size_t>(inverse.rows);
  inverse.values.reset(new float[pixels + kLanes]);
  std::fill(inverse.values.get() + pixels, inverse.values.get() + pixels + kLanes, 0.F);
  const double unit = image.units() != nullptr ? image.metresPerUnit() : 1.0;
  const double highest = image.units() != nullptr ? 65534.0 : 1e30;
  const Bounds bounds{static_cast<float>(std::max(min_depth / unit, 1e-30)),
                      static_cast<float>(std::min(max_depth / unit, highest)), static_cast<float>(1 / unit)};
  for (int y = 0; y < inverse.rows; ++y) {
    float* row = inverse.values.get() + static_cast<std::size_t>(y) * stride;
    const auto from = static_cast<std::size_t>(y) * width;
    if (y >= inverse.height) {
      std::fill(row, row + stride, 0.F);
      continue;
    }
    if (image.units() != nullptr) {
      invertRow(image.units() + from, inverse.width, bounds, row);
    } else {
      invertRow(image.metres() + from, inverse.width, bounds, row);
    }
    std::fill(row + width, row + stride, 0.F);
  }
  return inverse;
}

}  // namespace omnimapper::perception::planes

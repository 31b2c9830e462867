#include "RunSums.h"

#include "Lanes.h"

namespace omnimapper::perception::planes {

namespace {

constexpr float kColumns[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7};

struct LaneSums {
  Lanes r{}, xr{}, rr{}, z{}, xz{}, zr_zr{};
};

// `weight` is 1 or 0; where it is 0, `q` is not.
OMNIMAPPER_KERNEL_BODY void add(const Lanes& q, const Lanes& x, const Lanes& plane, const Lanes& weight, LaneSums& s) {
  const Lanes r = (q - plane) * weight, z = weight / q, zr = z * r;
  s.r += r;
  s.xr += x * r;
  s.rr += r * r;
  s.z += z;
  s.xz += x * z;
  s.zr_zr += zr * zr;
}

OMNIMAPPER_KERNEL_BODY double total(const Lanes& lanes) {
  double sum = 0;
  for (int i = 0; i < kLanes; ++i) sum += lanes[i];
  return sum;
}

OMNIMAPPER_KERNEL_BODY void sumRunBody(const float* values, int n, float start, float slope, RunSums& sums) {
  LaneSums s;
  Lanes columns, q, one = Lanes{} + 1.F;
  load(columns, kColumns);
  int i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    load(q, values + i);
    const Lanes x = columns + static_cast<float>(i);
    add(q, x, x * slope + start, one, s);
  }
  if (i < n) {
    load(q, values + i);
    const LaneMask inside = columns < static_cast<float>(n - i);
    const Lanes x = columns + static_cast<float>(i);
    add(inside ? q : one, x, x * slope + start, inside ? one : Lanes{}, s);
  }
  sums = {total(s.r), total(s.xr), total(s.rr), total(s.z), total(s.xz), total(s.zr_zr)};
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void sumRunAvx2(const float* values, int n, float start, float slope, RunSums& sums) {
  sumRunBody(values, n, start, slope, sums);
}
#endif

}  // namespace

RunSums sumRun(const float* values, int n, float start, float slope) {
  RunSums sums;
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) {
    sumRunAvx2(values, n, start, slope, sums);
    return sums;
  }
#endif
  sumRunBody(values, n, start, slope, sums);
  return sums;
}

}  // namespace omnimapper::perception::planes

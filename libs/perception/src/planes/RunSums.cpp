#include "RunSums.h"

#include "Lanes.h"

namespace omnimapper::perception::planes {

namespace {

struct LaneSums {
  Lanes r{}, xr{}, rr{}, z{}, xz{};
};

// `weight` is 1 or 0; `q` must not be 0, even where the weight is.
OMNIMAPPER_KERNEL_BODY void add(const Lanes& q, const Lanes& x, const Lanes& plane, const Lanes& weight, LaneSums& s) {
  const Lanes r = (q - plane) * weight, z = weight / q;
  s.r += r;
  s.xr += x * r;
  s.rr += r * r;
  s.z += z;
  s.xz += x * z;
}

OMNIMAPPER_KERNEL_BODY double total(const Lanes& lanes) {
  double sum = 0;
  for (int i = 0; i < kLanes; ++i) sum += lanes[i];
  return sum;
}

OMNIMAPPER_KERNEL_BODY void sumRunBody(const float* values, int n, float start, float slope, RunSums& sums) {
  LaneSums s;
  Lanes columns, q, one = Lanes{} + 1.F;
  load(columns, kLaneColumns);
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
  sums = {total(s.r), total(s.xr), total(s.rr), total(s.z), total(s.xz)};
}

OMNIMAPPER_KERNEL_BODY void sumRelativeSquaresBody(const float* values, int n, float start, float slope, double& sum) {
  Lanes columns, q, one = Lanes{} + 1.F, squares{};
  load(columns, kLaneColumns);
  int i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    load(q, values + i);
    const Lanes zr = (q - ((columns + static_cast<float>(i)) * slope + start)) / q;
    squares += zr * zr;
  }
  if (i < n) {
    load(q, values + i);
    const LaneMask inside = columns < static_cast<float>(n - i);
    const Lanes r = q - ((columns + static_cast<float>(i)) * slope + start);
    const Lanes zr = inside ? r / (inside ? q : one) : Lanes{};
    squares += zr * zr;
  }
  sum = total(squares);
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void sumRunAvx2(const float* values, int n, float start, float slope, RunSums& sums) {
  sumRunBody(values, n, start, slope, sums);
}

OMNIMAPPER_KERNEL_AVX2 void sumRelativeSquaresAvx2(const float* values, int n, float start, float slope, double& sum) {
  sumRelativeSquaresBody(values, n, start, slope, sum);
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

double sumRelativeSquares(const float* values, int n, float start, float slope) {
  double sum = 0;
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) {
    sumRelativeSquaresAvx2(values, n, start, slope, sum);
    return sum;
  }
#endif
  sumRelativeSquaresBody(values, n, start, slope, sum);
  return sum;
}

}  // namespace omnimapper::perception::planes

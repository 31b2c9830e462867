#include "WindowPlanes.h"

#include <algorithm>
#include <limits>

#include "Lanes.h"

namespace omnimapper::perception::planes {

namespace {

constexpr double kLargest = 32767;
constexpr float kNoPlane = std::numeric_limits<float>::quiet_NaN();
// Inverse square root of normal numbers, to 2 units in the last place: a first guess from the exponent, then Newton
// steps. Only plain operations are used, so that the result is the same to the bit on every machine.
OMNIMAPPER_KERNEL_BODY void inverseRoot(const Lanes& value, Lanes& root) {
  LaneMask bits;
  std::memcpy(&bits, &value, sizeof(bits));
  bits = 0x5f3759df - (bits >> 1);
  std::memcpy(&root, &bits, sizeof(root));
  for (int i = 0; i < 3; ++i) root = root * (1.5F - 0.5F * value * root * root);
}

OMNIMAPPER_KERNEL_BODY void roundBody(const float* from, int n, float scale, float* to) {
  for (int x = 0; x < n; x += kLanes) {
    Lanes q;
    load(q, from + x);
    const LaneMask whole = __builtin_convertvector(q * scale + 0.5F, LaneMask);
    store(__builtin_convertvector(whole, Lanes), to + x);
  }
}

struct ColumnRows {
  const float *leaving, *entering;
  float *missing, *sum, *moment;
};

OMNIMAPPER_KERNEL_BODY void slideBody(const ColumnRows& c, int n, float radius) {
  for (int x = 0; x < n; x += kLanes) {
    Lanes leaving, entering, missing, sum, moment;
    load(leaving, c.leaving + x);
    load(entering, c.entering + x);
    load(missing, c.missing + x);
    load(sum, c.sum + x);
    load(moment, c.moment + x);
    const Lanes one = Lanes{} + 1.F, zero = {};
    missing += (entering > 0.F ? zero : one) - (leaving > 0.F ? zero : one);
    moment += radius * entering + (radius + 1.F) * leaving - sum;
    sum += entering - leaving;
    store(missing, c.missing + x);
    store(sum, c.sum + x);
    store(moment, c.moment + x);
  }
}

struct RowTask {
  const float *above, *here, *below;  // rows of the image at the window's top, middle and bottom
  const float *missing, *sum, *moment;
  int radius;
  float per_pixel, per_spread;  // 1 / number of pixels, 1 / sum of squared columns over the window
  float tolerance;
  float fx, fy, cx, down;  // down: rows from the principal point
};

OMNIMAPPER_KERNEL_BODY void keepNear(const float* row, int x, const Lanes& plane, float tolerance, LaneMask& flat) {
  Lanes q;
  load(q, row + x);
  const Lanes residual = q - plane;
  flat &= (residual <= tolerance) & (residual >= -tolerance);
}

// Normals of the eight pixels from x on.
OMNIMAPPER_KERNEL_BODY void normalsAt(const RowTask& t, int x, const NormalRow& to) {
  Lanes missing, sum, moment;
  load(missing, t.missing + x);
  load(sum, t.sum + x);
  load(moment, t.moment + x);
  Lanes across = {};
  for (int k = 1; k <= t.radius; ++k) {
    Lanes left, right;
    load(left, t.missing + x - k);
    load(right, t.missing + x + k);
    missing += left + right;
    load(left, t.moment + x - k);
    load(right, t.moment + x + k);
    moment += left + right;
    load(left, t.sum + x - k);
    load(right, t.sum + x + k);
    sum += left + right;
    across += (right - left) * static_cast<float>(k);
  }
  const Lanes a = across * t.per_spread, b = moment * t.per_spread, middle = sum * t.per_pixel;
  const float reach = static_cast<float>(t.radius);
  LaneMask flat = missing == 0.F;
  const Lanes to_right = a * reach, to_below = b * reach;
  keepNear(t.above, x - t.radius, middle - to_right - to_below, t.tolerance, flat);
  keepNear(t.above, x, middle - to_below, t.tolerance, flat);
  keepNear(t.above, x + t.radius, middle + to_right - to_below, t.tolerance, flat);
  keepNear(t.here, x - t.radius, middle - to_right, t.tolerance, flat);
  keepNear(t.here, x, middle, t.tolerance, flat);
  keepNear(t.here, x + t.radius, middle + to_right, t.tolerance, flat);
  keepNear(t.below, x - t.radius, middle - to_right + to_below, t.tolerance, flat);
  keepNear(t.below, x, middle + to_below, t.tolerance, flat);
  keepNear(t.below, x + t.radius, middle + to_right + to_below, t.tolerance, flat);
  Lanes columns;
  load(columns, kLaneColumns);
  const Lanes wx = a * t.fx, wy = b * t.fy;
  const Lanes wz = middle - a * (columns + (static_cast<float>(x) - t.cx)) - b * t.down;
  Lanes scale;
  inverseRoot(wx * wx + wy * wy + wz * wz, scale);
  const Lanes none = Lanes{} + kNoPlane;
  store(flat ? -wx * scale : none, to.x + x);
  store(flat ? -wy * scale : none, to.y + x);
  store(flat ? -wz * scale : none, to.z + x);
}

// Normals of all columns whose windows are inside the image. Some of the last columns may be computed twice.
OMNIMAPPER_KERNEL_BODY void normalsBody(const RowTask& task, int width, const NormalRow& to) {
  const int last = width - task.radius - kLanes;
  for (int x = task.radius; x < last; x += kLanes) normalsAt(task, x, to);
  if (last >= task.radius) normalsAt(task, last, to);
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void roundAvx2(const float* from, int n, float scale, float* to) {
  roundBody(from, n, scale, to);
}
OMNIMAPPER_KERNEL_AVX2 void slideAvx2(const ColumnRows& columns, int n, float radius) {
  slideBody(columns, n, radius);
}
OMNIMAPPER_KERNEL_AVX2 void normalsAvx2(const RowTask& task, int width, const NormalRow& to) {
  normalsBody(task, width, to);
}
#endif

void round(const float* from, int n, float scale, float* to) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) return roundAvx2(from, n, scale, to);
#endif
  roundBody(from, n, scale, to);
}

std::unique_ptr<float[]> filled(int n, float value) {
  std::unique_ptr<float[]> values(new float[static_cast<std::size_t>(n)]);
  std::fill(values.get(), values.get() + n, value);
  return values;
}

}  // namespace

// The window starts above the image, where nothing is measured, and slides in.
WindowPlanes::WindowPlanes(const InverseDepth& inverse, const camera::Pinhole& camera, int radius, double highest,
                           double tolerance)
    : width_(inverse.width),
      stride_(inverse.stride),
      rows_(inverse.rows),
      radius_(radius),
      camera_(camera),
      tolerance_(static_cast<float>(tolerance * kLargest / highest)),
      missing_(filled(inverse.stride, static_cast<float>(2 * radius + 1))),
      sum_(filled(inverse.stride, 0)),
      moment_(filled(inverse.stride, 0)) {
  // One row of zeros follows the image.
  const int pixels = stride_ * rows_;
  whole_.reset(new float[static_cast<std::size_t>(pixels + stride_)]);
  round(inverse.values.get(), pixels, static_cast<float>(kLargest / highest), whole_.get());
  std::fill(whole_.get() + pixels, whole_.get() + pixels + stride_, 0.F);
  for (y_ = -radius; y_ < 0; ++y_) slide();
}

void WindowPlanes::slide() {
  const int leaving = y_ - radius_ - 1, entering = y_ + radius_;
  const ColumnRows columns{row(leaving < 0 ? rows_ : leaving), row(std::min(entering, rows_)), missing_.get(),
                           sum_.get(), moment_.get()};
  const auto radius = static_cast<float>(radius_);
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) return slideAvx2(columns, stride_, radius);
#endif
  slideBody(columns, stride_, radius);
}

void WindowPlanes::next(const NormalRow& to) {
  slide();
  const int side = 2 * radius_ + 1;
  const double spread = side * radius_ * (radius_ + 1) * side / 3.0;
  const RowTask task{row(y_ < radius_ ? rows_ : y_ - radius_),
                     row(y_),
                     row(std::min(y_ + radius_, rows_)),
                     missing_.get(),
                     sum_.get(),
                     moment_.get(),
                     radius_,
                     1.F / static_cast<float>(side * side),
                     static_cast<float>(1 / spread),
                     tolerance_,
                     static_cast<float>(camera_.fx),
                     static_cast<float>(camera_.fy),
                     static_cast<float>(camera_.cx),
                     static_cast<float>(y_ - camera_.cy)};
  const bool narrow = width_ < side + kLanes - 1;
  for (float* row : {to.x, to.y, to.z}) {
    std::fill(row, row + (narrow ? width_ : radius_), kNoPlane);
    std::fill(row + std::max(0, width_ - radius_), row + width_, kNoPlane);
  }
  ++y_;
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) return normalsAvx2(task, width_, to);
#endif
  normalsBody(task, width_, to);
}

}  // namespace omnimapper::perception::planes

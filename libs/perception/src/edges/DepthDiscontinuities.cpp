#include "DepthDiscontinuities.h"

#include <omnimapper/perception/EdgeImage.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "EdgeMask.h"

namespace omnimapper::perception::edges {

namespace {

using planes::kLanes;
using planes::LaneMask;
using planes::Lanes;

// Bits of a pixel's mask: its depth and that of a neighbour differ, or only one of the two was measured (hole).
enum DiscontinuityBits : std::int32_t {
  kRight = 1,
  kBelow = 2,
  kBelowRight = 4,
  kBelowLeft = 8,
  kHoleRight = 16,
  kHoleBelow = 32
};

// Temporary bits of a label: the pixel is beside a hole that is open, or beside one that was bridged.
constexpr std::uint8_t kOpen = 64, kBridged = 128;

struct DiscontinuityTask {
  const float *here, *below;
  float least, share;
};

OMNIMAPPER_KERNEL_BODY void compare(const Lanes& q, const float* neighbour, const DiscontinuityTask& task, int apart,
                                    int hole, LaneMask& masks) {
  Lanes other;
  planes::load(other, neighbour);
  const Lanes near = q > other ? q : other, far = q > other ? other : q;
  const Lanes difference = near - far;
  const LaneMask is_discontinuity = (far > 0.F) & (difference > task.least) & (difference > near * task.share);
  masks |= is_discontinuity & apart;
  if (hole != 0) masks |= (near > 0.F) & (far <= 0.F) & hole;
}

OMNIMAPPER_KERNEL_BODY void maskRowBody(const DiscontinuityTask& task, int n, std::uint8_t* to) {
  for (int x = 0; x < n; x += kLanes) {
    Lanes q;
    planes::load(q, task.here + x);
    LaneMask masks{};
    compare(q, task.here + x + 1, task, kRight, kHoleRight, masks);
    compare(q, task.below + x, task, kBelow, kHoleBelow, masks);
    compare(q, task.below + x + 1, task, kBelowRight, 0, masks);
    compare(q, task.below + x - 1, task, kBelowLeft, 0, masks);
    storeMasks(masks, to + x);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void maskRowAvx2(const DiscontinuityTask& task, int n, std::uint8_t* to) {
  maskRowBody(task, n, to);
}
#endif

void maskRow(const DiscontinuityTask& task, int n, std::uint8_t* to) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return maskRowAvx2(task, n, to);
#endif
  maskRowBody(task, n, to);
}

struct Pixel {
  int x, y;
};

class DiscontinuityFinder {
 public:
  DiscontinuityFinder(const planes::InverseDepth& inverse, const DiscontinuityThresholds& thresholds,
                      std::uint8_t* labels)
      : inverse_(inverse),
        thresholds_(thresholds),
        labels_(labels),
        before_hole_(static_cast<std::size_t>(inverse.width), kNone) {}

  void find() {
    std::vector<std::uint8_t> masks(static_cast<std::size_t>(inverse_.stride));
    // The last row is compared with a row without measurements.
    const std::vector<float> nothing(static_cast<std::size_t>(inverse_.stride + kLanes + 1), 0.F);
    for (int y = 0; y < inverse_.height; ++y) {
      const bool last = y + 1 == inverse_.height;
      const DiscontinuityTask task{inverse_.at(0, y), last ? nothing.data() + 1 : inverse_.at(0, y + 1),
                                   thresholds_.least, thresholds_.share};
      maskRow(task, inverse_.stride, masks.data());
      readRow(masks, y);
    }
    for (int x = 0; x < inverse_.width; ++x) {
      if (before_hole_[static_cast<std::size_t>(x)] != kNone) leaveOpen({x, before_hole_[static_cast<std::size_t>(x)]});
    }
    decideBoundary();
  }

 private:
  static constexpr int kNone = -1;

  float q(const Pixel& p) const { return *inverse_.at(p.x, p.y); }
  bool isInside(const Pixel& p) const { return p.x >= 0 && p.y >= 0 && p.x < inverse_.width && p.y < inverse_.height; }
  std::uint8_t& label(const Pixel& p) { return labels_[static_cast<std::ptrdiff_t>(p.y) * inverse_.width + p.x]; }

  void readRow(const std::vector<std::uint8_t>& masks, int y) {
    int before_hole = kNone;
    forEachMask(masks.data(), inverse_.stride, [&](int x) {
      if (x >= inverse_.width) return;
      const int mask = masks[static_cast<std::size_t>(x)];
      const Pixel here{x, y};
      const bool right = x + 1 < inverse_.width, below = y + 1 < inverse_.height;
      if ((mask & kRight) != 0 && right) compareAcross(here, {x + 1, y}, 1);
      if ((mask & kBelow) != 0 && below) compareAcross(here, {x, y + 1}, 1);
      if ((mask & kBelowRight) != 0 && right && below) compareAcross(here, {x + 1, y + 1}, 1);
      if ((mask & kBelowLeft) != 0 && x > 0 && below) compareAcross(here, {x - 1, y + 1}, 1);
      if ((mask & kHoleRight) != 0 && right) {
        if (q(here) > 0) {
          before_hole = x;
        } else {
          endHole({before_hole, y}, {x + 1, y}, x - before_hole);
          before_hole = kNone;
        }
      }
      if ((mask & kHoleBelow) != 0 && below) {
        int& above_hole = before_hole_[static_cast<std::size_t>(x)];
        if (q(here) > 0) {
          above_hole = y;
        } else {
          endHole({x, above_hole}, {x, y + 1}, y - above_hole);
          above_hole = kNone;
        }
      }
    });
    if (before_hole != kNone) leaveOpen({before_hole, y});
  }

  // Ends a hole of `n` pixels between two pixels of a row or column. `first` is outside the image where the hole
  // reaches the border.
  void endHole(const Pixel& first, const Pixel& second, int n) {
    if (isInside(first) && n <= thresholds_.max_hole) {
      compareAcross(first, second, n + 1);
      for (const Pixel& p : {first, second}) touch(p, kBridged);
    } else {
      if (isInside(first)) leaveOpen(first);
      leaveOpen(second);
    }
  }

  void leaveOpen(const Pixel& p) { touch(p, kOpen); }

  void touch(const Pixel& p, std::uint8_t bit) {
    if ((label(p) & (kOpen | kBridged)) == 0) touched_.push_back(p);
    label(p) |= bit;
  }

  // Labels both pixels if there is a depth discontinuity between them. `second` is `steps` steps from `first` on a row,
  // a column or a diagonal.
  void compareAcross(const Pixel& first, const Pixel& second, int steps) {
    const float a = q(first), b = q(second), difference = b - a;
    const float far_apart = std::max(thresholds_.least, std::max(a, b) * thresholds_.share);
    if (std::abs(difference) <= far_apart) return;
    const Pixel step{(second.x - first.x) / steps, (second.y - first.y) / steps};
    const float onward = slope(first, {-step.x, -step.y}), back = slope(second, step);
    // Continues the surface of the first pixel to the second one, and the other way round.
    if (!stays(difference, -onward, steps) || !stays(difference, back, steps)) return;
    label(a > b ? first : second) |= kOccluding;
    label(a > b ? second : first) |= kOccluded;
  }

  // Whether the difference still exceeds the noise when the surface on one side is continued with its slope.
  bool stays(float difference, float slope, int steps) const {
    if (slope == 0) return true;
    const auto n = static_cast<float>(steps);
    const float rest = difference > 0 ? difference - n * slope : n * slope - difference;
    // The variance of the slope is a quarter of that of the difference of two pixels.
    return rest > thresholds_.least * std::sqrt(1 + 0.25F * n * n);
  }

  // Slope of the inverse depth for each step away from a pixel; 0 if the slopes of the first two steps and of the next
  // two differ in sign, or nothing was measured there.
  float slope(const Pixel& from, const Pixel& step) const {
    const Pixel nearer{from.x + 2 * step.x, from.y + 2 * step.y}, farther{from.x + 4 * step.x, from.y + 4 * step.y};
    const float a = q(from), b = isInside(nearer) ? q(nearer) : 0, c = isInside(farther) ? q(farther) : 0;
    if (!(b > 0)) return 0;
    const float first = 0.5F * (b - a);
    if (!isInside(farther)) return first;
    if (!(c > 0) || (b > a) != (c > b)) return 0;
    const float second = 0.5F * (c - b);
    return std::abs(first) < std::abs(second) ? first : second;
  }

  void decideBoundary() {
    for (const Pixel& p : touched_) {
      std::uint8_t& of_pixel = label(p);
      if ((of_pixel & (kBridged | kOccluding | kOccluded)) == 0) of_pixel |= kBoundary;
      of_pixel &= static_cast<std::uint8_t>(~(kOpen | kBridged));
    }
  }

  const planes::InverseDepth& inverse_;
  const DiscontinuityThresholds& thresholds_;
  std::uint8_t* labels_;
  std::vector<int> before_hole_;  // for each column, the row above the current hole, or kNone
  std::vector<Pixel> touched_;    // pixels beside holes
};

}  // namespace

void labelDepthDiscontinuities(const planes::InverseDepth& inverse, const DiscontinuityThresholds& thresholds,
                               std::uint8_t* labels) {
  DiscontinuityFinder(inverse, thresholds, labels).find();
}

}  // namespace omnimapper::perception::edges

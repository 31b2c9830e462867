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

// What a pixel and a neighbour may be to each other: far apart, or only one of them measured.
enum JumpMark : std::int32_t {
  kRight = 1,
  kBelow = 2,
  kBelowRight = 4,
  kBelowLeft = 8,
  kHoleRight = 16,
  kHoleBelow = 32
};

// While labels are made: beside a hole that nothing was found behind; beside one that was bridged.
constexpr std::uint8_t kOpen = 64, kBridged = 128;

struct JumpTask {
  const float *here, *below;
  float least, share;
};

OMNIMAPPER_KERNEL_BODY void compare(const Lanes& q, const float* neighbour, const JumpTask& task, int apart, int hole,
                                    LaneMask& marks) {
  Lanes other;
  planes::load(other, neighbour);
  const Lanes near = q > other ? q : other, far = q > other ? other : q;
  const Lanes difference = near - far;
  const LaneMask jump = (far > 0.F) & (difference > task.least) & (difference > near * task.share);
  marks |= jump & apart;
  if (hole != 0) marks |= (near > 0.F) & (far <= 0.F) & hole;
}

OMNIMAPPER_KERNEL_BODY void markRowBody(const JumpTask& task, int n, std::uint8_t* to) {
  for (int x = 0; x < n; x += kLanes) {
    Lanes q;
    planes::load(q, task.here + x);
    LaneMask marks{};
    compare(q, task.here + x + 1, task, kRight, kHoleRight, marks);
    compare(q, task.below + x, task, kBelow, kHoleBelow, marks);
    compare(q, task.below + x + 1, task, kBelowRight, 0, marks);
    compare(q, task.below + x - 1, task, kBelowLeft, 0, marks);
    storeMarks(marks, to + x);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void markRowAvx2(const JumpTask& task, int n, std::uint8_t* to) {
  markRowBody(task, n, to);
}
#endif

void markRow(const JumpTask& task, int n, std::uint8_t* to) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return markRowAvx2(task, n, to);
#endif
  markRowBody(task, n, to);
}

struct Pixel {
  int x, y;
};

class JumpMarking {
 public:
  JumpMarking(const planes::InverseDepth& inverse, const JumpThresholds& thresholds, std::uint8_t* labels)
      : inverse_(inverse),
        thresholds_(thresholds),
        labels_(labels),
        before_hole_(static_cast<std::size_t>(inverse.width), kNone) {}

  void mark() {
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(inverse_.stride));
    // A row of nothing below the last one.
    const std::vector<float> nothing(static_cast<std::size_t>(inverse_.stride + kLanes + 1), 0.F);
    for (int y = 0; y < inverse_.height; ++y) {
      const bool last = y + 1 == inverse_.height;
      const JumpTask task{inverse_.at(0, y), last ? nothing.data() + 1 : inverse_.at(0, y + 1), thresholds_.least,
                          thresholds_.share};
      markRow(task, inverse_.stride, marks.data());
      readRow(marks, y);
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

  void readRow(const std::vector<std::uint8_t>& marks, int y) {
    int before_hole = kNone;
    forEachMark(marks.data(), inverse_.stride, [&](int x) {
      if (x >= inverse_.width) return;
      const int mark = marks[static_cast<std::size_t>(x)];
      const Pixel here{x, y};
      const bool right = x + 1 < inverse_.width, below = y + 1 < inverse_.height;
      if ((mark & kRight) != 0 && right) compareAcross(here, {x + 1, y}, 1);
      if ((mark & kBelow) != 0 && below) compareAcross(here, {x, y + 1}, 1);
      if ((mark & kBelowRight) != 0 && right && below) compareAcross(here, {x + 1, y + 1}, 1);
      if ((mark & kBelowLeft) != 0 && x > 0 && below) compareAcross(here, {x - 1, y + 1}, 1);
      if ((mark & kHoleRight) != 0 && right) {
        if (q(here) > 0) {
          before_hole = x;
        } else {
          endHole({before_hole, y}, {x + 1, y}, x - before_hole);
          before_hole = kNone;
        }
      }
      if ((mark & kHoleBelow) != 0 && below) {
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

  // A hole of `n` pixels between two of a row or column; the first is outside where the hole reaches the border.
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

  // `second` is `steps` steps from `first`, straight on.
  void compareAcross(const Pixel& first, const Pixel& second, int steps) {
    const float a = q(first), b = q(second), difference = b - a;
    const float far_apart = std::max(thresholds_.least, std::max(a, b) * thresholds_.share);
    if (std::abs(difference) <= far_apart) return;
    const Pixel step{(second.x - first.x) / steps, (second.y - first.y) / steps};
    const float onward = slope(first, {-step.x, -step.y}), back = slope(second, step);
    // The surface of the first, continued to the second, and the other way round.
    if (!stays(difference, -onward, steps) || !stays(difference, back, steps)) return;
    label(a > b ? first : second) |= kOccluding;
    label(a > b ? second : first) |= kOccluded;
  }

  // Whether a difference remains one when the surface on a side is continued with its slope.
  bool stays(float difference, float slope, int steps) const {
    if (slope == 0) return true;
    const auto n = static_cast<float>(steps);
    const float rest = difference > 0 ? difference - n * slope : n * slope - difference;
    // The slope is known to a quarter of the variance of a difference of pixels.
    return rest > thresholds_.least * std::sqrt(1 + 0.25F * n * n);
  }

  // Of the inverse depth, for each step away from a pixel; 0 if the slopes of the first two steps and of the next two
  // do not agree, or nothing is measured there.
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
  const JumpThresholds& thresholds_;
  std::uint8_t* labels_;
  std::vector<int> before_hole_;  // of each column: the row above the hole that we are in
  std::vector<Pixel> touched_;
};

}  // namespace

void markJumps(const planes::InverseDepth& inverse, const JumpThresholds& thresholds, std::uint8_t* labels) {
  JumpMarking(inverse, thresholds, labels).mark();
}

}  // namespace omnimapper::perception::edges

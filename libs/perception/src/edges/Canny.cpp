#include "Canny.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "Marks.h"

namespace omnimapper::perception::edges {

namespace {

using Bytes16 = std::uint8_t __attribute__((vector_size(16)));

int wholeLanes(int n) {
  return (n + kShorts - 1) / kShorts * kShorts;
}

// The weights of ITU-R BT.601 in parts of 256.
template <int kFirst, int kThird>
OMNIMAPPER_KERNEL_BODY void greyBody(const std::uint8_t* from, int n, std::uint8_t* to) {
  for (int x = 0; x < n; ++x, from += 3) {
    to[x] = static_cast<std::uint8_t>((kFirst * from[0] + 150 * from[1] + kThird * from[2] + 128) >> 8);
  }
}

// Sums over three rows: smoothed down, and the difference down.
struct ThreeRows {
  const std::uint8_t *above, *here, *below;
};

OMNIMAPPER_KERNEL_BODY void loadShorts(Shorts& shorts, const std::uint8_t* from) {
  Bytes16 bytes;
  std::memcpy(&bytes, from, sizeof(bytes));
  shorts = __builtin_convertvector(bytes, Shorts);
}
OMNIMAPPER_KERNEL_BODY void loadShorts(Shorts& shorts, const std::int16_t* from) {
  std::memcpy(&shorts, from, sizeof(shorts));
}
OMNIMAPPER_KERNEL_BODY void storeShorts(const Shorts& shorts, std::int16_t* to) {
  std::memcpy(to, &shorts, sizeof(shorts));
}

// Of n columns, a multiple of 16.
OMNIMAPPER_KERNEL_BODY void sumDownBody(const ThreeRows& rows, int n, std::int16_t* smooth, std::int16_t* difference) {
  for (int x = 0; x < n; x += kShorts) {
    Shorts a, b, c;
    loadShorts(a, rows.above + x);
    loadShorts(b, rows.here + x);
    loadShorts(c, rows.below + x);
    const Shorts sum = a + b + b + c, down = c - a;
    storeShorts(sum, smooth + x);
    storeShorts(down, difference + x);
  }
}

struct GradientRow {
  std::int16_t *x, *y, *size;
};

struct Thresholds {
  std::int16_t low, high;
};

// `smooth` and `difference` begin one column before the first.
OMNIMAPPER_KERNEL_BODY void gradientBody(const std::int16_t* smooth, const std::int16_t* difference, int n,
                                         const GradientRow& to) {
  for (int x = 0; x < n; x += kShorts) {
    Shorts left, middle, right;
    loadShorts(left, smooth + x);
    loadShorts(right, smooth + x + 2);
    const Shorts across = right - left;
    loadShorts(left, difference + x);
    loadShorts(middle, difference + x + 1);
    loadShorts(right, difference + x + 2);
    const Shorts down = left + middle + middle + right, zero{};
    const Shorts size = (across < zero ? -across : across) + (down < zero ? -down : down);
    storeShorts(across, to.x + x);
    storeShorts(down, to.y + x);
    storeShorts(size, to.size + x);
  }
}

// Marks the pixels where the gradient is largest of the three along its direction to 45 degrees; of two that are equal
// the first one is.
OMNIMAPPER_KERNEL_BODY void thinBody(const GradientRow& row, const std::int16_t* above, const std::int16_t* below,
                                     int n, const Thresholds& thresholds, std::uint8_t* marks) {
  constexpr std::uint16_t kTan = 27146;  // of 22.5 degrees, times 2^16
  for (int x = 0; x < n; x += kShorts) {
    Shorts gx, gy, size;
    loadShorts(gx, row.x + x);
    loadShorts(gy, row.y + x);
    loadShorts(size, row.size + x);
    const Shorts zero{}, across = gx < zero ? -gx : gx, down = gy < zero ? -gy : gy;
    Shorts bound;
    scaleDown(across, kTan, bound);
    const Shorts level = down <= bound, upright = down > bound + across + across, rising = (gx ^ gy) < zero;
    Shorts before, after;
    loadShorts(before, row.size + x - 1);
    loadShorts(after, row.size + x + 1);
    Shorts largest = level & (size > before) & (size >= after);
    loadShorts(before, above + x);
    loadShorts(after, below + x);
    largest |= upright & (size > before) & (size >= after);
    loadShorts(before, above + x + 1);
    loadShorts(after, below + x - 1);
    const Shorts aslant = ~(level | upright);
    largest |= aslant & rising & (size > before) & (size > after);
    loadShorts(before, above + x - 1);
    loadShorts(after, below + x + 1);
    largest |= aslant & ~rising & (size > before) & (size > after);
    storeMarks(largest & (size > thresholds.low) & (1 + ((size > thresholds.high) & 1)), marks + x);
  }
}

OMNIMAPPER_KERNEL_BODY void greyOf(ColourImage::Order order, const std::uint8_t* from, int n, std::uint8_t* to) {
  if (order == ColourImage::Order::grey) {
    std::copy(from, from + n, to);
  } else if (order == ColourImage::Order::rgb) {
    greyBody<77, 29>(from, n, to);
  } else {
    greyBody<29, 77>(from, n, to);
  }
}

struct RowBuffers {
  ThreeRows grey;  // from the column before the first
  std::int16_t *smooth, *difference;
  GradientRow gradient;
};

OMNIMAPPER_KERNEL_BODY void gradientRowBody(const RowBuffers& row, int n) {
  sumDownBody(row.grey, n + kShorts, row.smooth, row.difference);
  gradientBody(row.smooth, row.difference, n, row.gradient);
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void greyAvx2(ColourImage::Order order, const std::uint8_t* from, int n, std::uint8_t* to) {
  greyOf(order, from, n, to);
}
OMNIMAPPER_KERNEL_AVX2 void gradientRowAvx2(const RowBuffers& row, int n) {
  gradientRowBody(row, n);
}
OMNIMAPPER_KERNEL_AVX2 void thinAvx2(const GradientRow& row, const std::int16_t* above, const std::int16_t* below,
                                     int n, const Thresholds& thresholds, std::uint8_t* marks) {
  thinBody(row, above, below, n, thresholds, marks);
}
#endif

void grey(ColourImage::Order order, const std::uint8_t* from, int n, std::uint8_t* to) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return greyAvx2(order, from, n, to);
#endif
  greyOf(order, from, n, to);
}

void gradientRow(const RowBuffers& row, int n) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return gradientRowAvx2(row, n);
#endif
  gradientRowBody(row, n);
}

void thin(const GradientRow& row, const std::int16_t* above, const std::int16_t* below, int n,
          const Thresholds& thresholds, std::uint8_t* marks) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return thinAvx2(row, above, below, n, thresholds, marks);
#endif
  thinBody(row, above, below, n, thresholds, marks);
}

/// The last three rows of grey and of gradients, each with room before its first pixel and behind its last.
class Rows {
 public:
  explicit Rows(int width)
      : width_(width),
        stride_(wholeLanes(width) + 2 * kShorts),
        grey_(3 * static_cast<std::size_t>(stride_), 0),
        shorts_(11 * static_cast<std::size_t>(stride_), 0),
        marks_(static_cast<std::size_t>(stride_), 0) {}

  void fillGrey(const ColourImage& image, int y) {
    std::uint8_t* to = grey(y);
    edges::grey(image.order, image.pixels + static_cast<std::ptrdiff_t>(y) * image.stride, width_, to);
    to[-1] = to[0];
    to[width_] = to[width_ - 1];
  }

  void fillGradient(int y, int height) {
    const RowBuffers row{{grey(std::max(0, y - 1)) - 1, grey(y) - 1, grey(std::min(height - 1, y + 1)) - 1},
                         shorts_.data() + 9 * stride_,
                         shorts_.data() + 10 * stride_,
                         gradient(y)};
    gradientRow(row, wholeLanes(width_));
    row.gradient.size[width_] = 0;
  }

  void clearGradient(int y) {
    const GradientRow row = gradient(y);
    std::fill(row.size - 1, row.size + width_ + 1, static_cast<std::int16_t>(0));
  }

  /// Candidates of a row whose gradients and those of its neighbours are filled.
  void mark(int y, const Thresholds& thresholds, Candidates& candidates) {
    thin(gradient(y), gradient(y - 1).size, gradient(y + 1).size, wholeLanes(width_), thresholds, marks_.data());
    std::fill(marks_.begin() + width_, marks_.end(), static_cast<std::uint8_t>(0));
    std::copy(marks_.begin(), marks_.begin() + width_, candidates.row(y));
    forEachMark(marks_.data(), wholeLanes(width_), [&](int x) {
      if (marks_[static_cast<std::size_t>(x)] == Candidates::kStrong) candidates.addStrong(x, y);
    });
  }

 private:
  std::uint8_t* grey(int y) { return grey_.data() + slot(y) + kShorts; }
  GradientRow gradient(int y) {
    std::int16_t* from = shorts_.data() + slot(y) + kShorts;
    return {from, from + 3 * stride_, from + 6 * stride_};
  }
  std::ptrdiff_t slot(int y) const { return (y + 3) % 3 * stride_; }

  int width_;
  std::ptrdiff_t stride_;
  std::vector<std::uint8_t> grey_;
  std::vector<std::int16_t> shorts_;  // three rows each of x, y and size, then two rows of sums
  std::vector<std::uint8_t> marks_;
};

}  // namespace

Candidates canny(const ColourImage& image, int low, int high) {
  Candidates candidates(image.width, image.height);
  if (image.width == 0 || image.height == 0) return candidates;
  const Thresholds thresholds{static_cast<std::int16_t>(low), static_cast<std::int16_t>(high)};
  Rows rows(image.width);
  rows.clearGradient(-1);
  rows.fillGrey(image, 0);
  if (image.height > 1) rows.fillGrey(image, 1);
  rows.fillGradient(0, image.height);
  for (int y = 0; y < image.height; ++y) {
    if (y + 2 < image.height) rows.fillGrey(image, y + 2);
    if (y + 1 < image.height) {
      rows.fillGradient(y + 1, image.height);
    } else {
      rows.clearGradient(y + 1);
    }
    rows.mark(y, thresholds, candidates);
  }
  candidates.keepConnected(1);
  return candidates;
}

}  // namespace omnimapper::perception::edges

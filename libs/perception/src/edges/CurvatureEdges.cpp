#include "CurvatureEdges.h"

#include <omnimapper/perception/EdgeImage.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "EdgeMask.h"
#include "Hysteresis.h"

namespace omnimapper::perception::edges {

namespace {

using planes::kLanes;
using planes::LaneMask;
using planes::Lanes;

// Bits of a pixel's mask: its normal and that of a neighbour differ (turn), or only one of the two has a normal (gap).
enum CurvatureBits : std::int32_t { kTurnRight = 1, kTurnBelow = 2, kGapRight = 4, kGapBelow = 8 };

struct CurvatureTask {
  const float *x, *y, *z;  // normals of the row
  const float* inverse;
  float least, noise;  // thresholds of the squared chord between unit normals; that of the noise is at 1/z = 1
};

OMNIMAPPER_KERNEL_BODY void compare(const CurvatureTask& task, int at, std::ptrdiff_t step, int turned, int gap,
                                    LaneMask& masks) {
  Lanes x, y, z, other_x, other_y, other_z, q;
  planes::load(x, task.x + at);
  planes::load(y, task.y + at);
  planes::load(z, task.z + at);
  planes::load(other_x, task.x + at + step);
  planes::load(other_y, task.y + at + step);
  planes::load(other_z, task.z + at + step);
  planes::load(q, task.inverse + at);
  x -= other_x;
  y -= other_y;
  const Lanes dz = z - other_z;
  const Lanes chord = x * x + y * y + dz * dz;
  masks |= (chord > task.least) & (chord * q * q > task.noise) & turned;
  masks |= ((z == z) ^ (other_z == other_z)) & gap;
}

// Computes the masks of a row's pixels up to `end`. `below`: whether there is a row below.
OMNIMAPPER_KERNEL_BODY void maskRowBody(const CurvatureTask& task, int end, int width, bool below, std::uint8_t* to) {
  for (int x = 0; x < end; x += kLanes) {
    LaneMask masks{};
    compare(task, x, 1, kTurnRight, kGapRight, masks);
    if (below) compare(task, x, width, kTurnBelow, kGapBelow, masks);
    storeMasks(masks, to + x);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void maskRowAvx2(const CurvatureTask& task, int end, int width, bool below, std::uint8_t* to) {
  maskRowBody(task, end, width, below, to);
}
#endif

void maskRow(const CurvatureTask& task, int end, int width, bool below, std::uint8_t* to) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return maskRowAvx2(task, end, width, below, to);
#endif
  maskRowBody(task, end, width, below, to);
}

float squaredChord(double angle) {
  const double chord = 2 * std::sin(0.5 * std::min(angle, 3.14159265358979323846));
  return static_cast<float>(chord * chord);
}

class CurvatureEdgeFinder {
 public:
  CurvatureEdgeFinder(const planes::InverseDepth& inverse, const camera::Pinhole& camera, const NormalImage& normals,
                      const CurvatureThresholds& thresholds, std::uint8_t* labels)
      : inverse_(inverse),
        camera_(camera),
        normals_(normals),
        thresholds_(thresholds),
        least_(squaredChord(thresholds.least)),
        noise_(static_cast<float>(thresholds.noise_at_1m * thresholds.noise_at_1m)),
        labels_(labels),
        turns_(normals.width, normals.height),
        before_gap_(static_cast<std::size_t>(normals.width), kNone) {}

  void find() {
    const int width = normals_.width, height = normals_.height;
    std::vector<std::uint8_t> masks(static_cast<std::size_t>(inverse_.stride + kLanes), 0);
    for (int y = 0; y < height; ++y) {
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * width;
      const CurvatureTask task{
          normals_.x() + first, normals_.y() + first, normals_.z() + first, inverse_.at(0, y), least_, noise_};
      // Eight lanes from the last but one column on would read past the image: those pixels are computed one by one.
      const int lanes_end = std::max(0, (width - 1) / kLanes * kLanes);
      maskRow(task, lanes_end, width, y + 1 < height, masks.data());
      for (int x = lanes_end; x < width; ++x) masks[static_cast<std::size_t>(x)] = maskOf(x, y);
      readRow(masks, y);
    }
    turns_.keepConnected(thresholds_.min_pixels);
    for (const EdgePixel& edge_pixel : edge_pixels_) {
      if (turns_.row(edge_pixel.turn_y)[edge_pixel.turn_x] == Candidates::kKept) {
        labels_[index(edge_pixel.x, edge_pixel.y)] |= kHighCurvature;
      }
    }
  }

 private:
  static constexpr int kNone = -1;

  // A pixel of a curvature edge, and the pixel where the change of the normals was found.
  struct EdgePixel {
    int turn_x, turn_y, x, y;
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(normals_.width) + static_cast<std::size_t>(x);
  }
  bool hasNormal(int x, int y) const { return !std::isnan(normals_.z()[index(x, y)]); }

  bool turns(int x, int y, int other_x, int other_y) const {
    const std::size_t i = index(x, y), j = index(other_x, other_y);
    const float dx = normals_.x()[i] - normals_.x()[j], dy = normals_.y()[i] - normals_.y()[j],
                dz = normals_.z()[i] - normals_.z()[j];
    const float chord = dx * dx + dy * dy + dz * dz, q = *inverse_.at(x, y);
    return chord > least_ && chord * q * q > noise_;
  }

  std::uint8_t maskOf(int x, int y) const {
    int mask = 0;
    if (x + 1 < normals_.width) {
      mask |= turns(x, y, x + 1, y) ? kTurnRight : 0;
      mask |= hasNormal(x, y) != hasNormal(x + 1, y) ? kGapRight : 0;
    }
    if (y + 1 < normals_.height) {
      mask |= turns(x, y, x, y + 1) ? kTurnBelow : 0;
      mask |= hasNormal(x, y) != hasNormal(x, y + 1) ? kGapBelow : 0;
    }
    return static_cast<std::uint8_t>(mask);
  }

  void readRow(const std::vector<std::uint8_t>& masks, int y) {
    int before_gap = kNone;
    forEachMask(masks.data(), static_cast<int>(masks.size()) - kLanes, [&](int x) {
      const int mask = masks[static_cast<std::size_t>(x)];
      if ((mask & kTurnRight) != 0) addTurn({x, y, 1, 0, 1});
      if ((mask & kTurnBelow) != 0) addTurn({x, y, 0, 1, 1});
      if ((mask & kGapRight) != 0) {
        if (!hasNormal(x, y) && before_gap != kNone) endGap({before_gap, y, 1, 0, x + 1 - before_gap});
        before_gap = x;
      }
      if ((mask & kGapBelow) != 0) {
        int& above_gap = before_gap_[static_cast<std::size_t>(x)];
        if (!hasNormal(x, y) && above_gap != kNone) endGap({x, above_gap, 0, 1, y + 1 - above_gap});
        above_gap = y;
      }
    });
  }

  // A pixel and the one n steps from it along a row or column.
  struct Pair {
    int x, y, dx, dy, n;
    int xAt(int k) const { return x + k * dx; }
    int yAt(int k) const { return y + k * dy; }
  };

  void endGap(const Pair& pair) {
    if (pair.n - 1 <= thresholds_.max_gap && turns(pair.x, pair.y, pair.xAt(pair.n), pair.yAt(pair.n))) addTurn(pair);
  }

  // The normals change where the pixels begin to deviate from the plane of one side; the edge is put where the planes
  // of both sides meet.
  void addTurn(const Pair& pair) {
    const Side one = sideOf(pair, 0, -1), other = sideOf(pair, pair.n, 1);
    const float meet =
        (other.inverse - other.slope * static_cast<float>(pair.n) - one.inverse) / (one.slope - other.slope);
    const float middle = 0.5F * static_cast<float>(pair.n);
    if (!(std::abs(meet - middle) <= middle + static_cast<float>(thresholds_.max_gap))) return;
    const int k = static_cast<int>(std::lround(meet));
    if (!isInside(pair.xAt(k), pair.yAt(k)) || crossesDiscontinuity(pair, std::min(k, 0), std::max(k, pair.n))) return;
    if (!(*inverse_.at(pair.xAt(k), pair.yAt(k)) > 0)) return;
    turns_.addStrong(pair.x, pair.y);
    edge_pixels_.push_back({pair.x, pair.y, pair.xAt(k), pair.yAt(k)});
  }

  // The inverse depth of a plane along a pair: its value at one pixel, and its increase with each step.
  struct Side {
    float inverse, slope;
  };

  // The plane of a side. Its value at the k-th pixel is the mean of up to four measurements from that pixel on, away
  // from the other side, each carried to the k-th pixel along the slope that the normal gives.
  Side sideOf(const Pair& pair, int k, int away) const {
    constexpr int kPixels = 4;
    const std::size_t i = index(pair.xAt(k), pair.yAt(k));
    const float across =
        (static_cast<float>(pair.xAt(k)) - static_cast<float>(camera_.cx)) / static_cast<float>(camera_.fx);
    const float down =
        (static_cast<float>(pair.yAt(k)) - static_cast<float>(camera_.cy)) / static_cast<float>(camera_.fy);
    const float facing = normals_.x()[i] * across + normals_.y()[i] * down + normals_.z()[i];
    const float growth = pair.dx != 0 ? normals_.x()[i] / static_cast<float>(camera_.fx)
                                      : normals_.y()[i] / static_cast<float>(camera_.fy);
    Side side{0, *inverse_.at(pair.xAt(k), pair.yAt(k)) * growth / facing};
    int n = 0;
    for (int j = 0; j < kPixels; ++j) {
      const int x = pair.xAt(k + j * away), y = pair.yAt(k + j * away);
      if (!isInside(x, y) || !(*inverse_.at(x, y) > 0)) break;
      side.inverse += *inverse_.at(x, y) - static_cast<float>(j * away) * side.slope;
      ++n;
    }
    side.inverse /= static_cast<float>(n);
    return side;
  }

  bool isInside(int x, int y) const { return x >= 0 && y >= 0 && x < normals_.width && y < normals_.height; }

  // Whether a depth discontinuity is among the pixels from `first` to `last` on a pair's line.
  bool crossesDiscontinuity(const Pair& pair, int first, int last) const {
    for (int k = first; k <= last; ++k) {
      if ((labels_[index(pair.xAt(k), pair.yAt(k))] & (kOccluding | kOccluded)) != 0) return true;
    }
    return false;
  }

  const planes::InverseDepth& inverse_;
  const camera::Pinhole& camera_;
  const NormalImage& normals_;
  const CurvatureThresholds& thresholds_;
  float least_, noise_;
  std::uint8_t* labels_;
  Candidates turns_;
  std::vector<EdgePixel> edge_pixels_;
  std::vector<int> before_gap_;  // for each column, the row above the current gap, or kNone
};

}  // namespace

void labelCurvatureEdges(const planes::InverseDepth& inverse, const camera::Pinhole& camera, const NormalImage& normals,
                         const CurvatureThresholds& thresholds, std::uint8_t* labels) {
  CurvatureEdgeFinder(inverse, camera, normals, thresholds, labels).find();
}

}  // namespace omnimapper::perception::edges

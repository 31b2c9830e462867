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

// What a pixel and its neighbour may be to each other: of other direction, or only one of them with a normal.
enum CreaseMark : std::int32_t { kCreaseRight = 1, kCreaseBelow = 2, kGapRight = 4, kGapBelow = 8 };

struct CreaseTask {
  const float *x, *y, *z;  // normals of the row
  const float* inverse;
  float least, noise;  // squared chords between unit normals; that of noise at 1/z = 1
};

OMNIMAPPER_KERNEL_BODY void compare(const CreaseTask& task, int at, std::ptrdiff_t step, int turned, int gap,
                                    LaneMask& marks) {
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
  marks |= (chord > task.least) & (chord * q * q > task.noise) & turned;
  marks |= ((z == z) ^ (other_z == other_z)) & gap;
}

// `below`: whether there is a row below.
OMNIMAPPER_KERNEL_BODY void markRowBody(const CreaseTask& task, int end, int width, bool below, std::uint8_t* to) {
  for (int x = 0; x < end; x += kLanes) {
    LaneMask marks{};
    compare(task, x, 1, kCreaseRight, kGapRight, marks);
    if (below) compare(task, x, width, kCreaseBelow, kGapBelow, marks);
    storeMarks(marks, to + x);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void markRowAvx2(const CreaseTask& task, int end, int width, bool below, std::uint8_t* to) {
  markRowBody(task, end, width, below, to);
}
#endif

void markRow(const CreaseTask& task, int end, int width, bool below, std::uint8_t* to) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return markRowAvx2(task, end, width, below, to);
#endif
  markRowBody(task, end, width, below, to);
}

float squaredChord(double angle) {
  const double chord = 2 * std::sin(0.5 * std::min(angle, 3.14159265358979323846));
  return static_cast<float>(chord * chord);
}

class CreaseMarking {
 public:
  CreaseMarking(const planes::InverseDepth& inverse, const Pinhole& camera, const NormalImage& normals,
                const CreaseThresholds& thresholds, std::uint8_t* labels)
      : inverse_(inverse),
        camera_(camera),
        normals_(normals),
        thresholds_(thresholds),
        least_(squaredChord(thresholds.least)),
        noise_(static_cast<float>(thresholds.noise_at_1m * thresholds.noise_at_1m)),
        labels_(labels),
        turns_(normals.width, normals.height),
        before_gap_(static_cast<std::size_t>(normals.width), kNone) {}

  void mark() {
    const int width = normals_.width, height = normals_.height;
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(inverse_.stride + kLanes), 0);
    for (int y = 0; y < height; ++y) {
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * width;
      const CreaseTask task{
          normals_.x() + first, normals_.y() + first, normals_.z() + first, inverse_.at(0, y), least_, noise_};
      // Eight from the last but one column on would read behind the image; those few are done by themselves.
      const int lanes_end = std::max(0, (width - 1) / kLanes * kLanes);
      markRow(task, lanes_end, width, y + 1 < height, marks.data());
      for (int x = lanes_end; x < width; ++x) marks[static_cast<std::size_t>(x)] = markOf(x, y);
      readRow(marks, y);
    }
    turns_.keepConnected(thresholds_.min_pixels);
    for (const Crease& crease : creases_) {
      if (turns_.row(crease.turn_y)[crease.turn_x] == Candidates::kKept) {
        labels_[index(crease.x, crease.y)] |= kHighCurvature;
      }
    }
  }

 private:
  static constexpr int kNone = -1;

  // Where the normals turn, and where the crease is.
  struct Crease {
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

  std::uint8_t markOf(int x, int y) const {
    int mark = 0;
    if (x + 1 < normals_.width) {
      mark |= turns(x, y, x + 1, y) ? kCreaseRight : 0;
      mark |= hasNormal(x, y) != hasNormal(x + 1, y) ? kGapRight : 0;
    }
    if (y + 1 < normals_.height) {
      mark |= turns(x, y, x, y + 1) ? kCreaseBelow : 0;
      mark |= hasNormal(x, y) != hasNormal(x, y + 1) ? kGapBelow : 0;
    }
    return static_cast<std::uint8_t>(mark);
  }

  void readRow(const std::vector<std::uint8_t>& marks, int y) {
    int before_gap = kNone;
    forEachMark(marks.data(), static_cast<int>(marks.size()) - kLanes, [&](int x) {
      const int mark = marks[static_cast<std::size_t>(x)];
      if ((mark & kCreaseRight) != 0) addTurn({x, y, 1, 0, 1});
      if ((mark & kCreaseBelow) != 0) addTurn({x, y, 0, 1, 1});
      if ((mark & kGapRight) != 0) {
        if (!hasNormal(x, y) && before_gap != kNone) endGap({before_gap, y, 1, 0, x + 1 - before_gap});
        before_gap = x;
      }
      if ((mark & kGapBelow) != 0) {
        int& above_gap = before_gap_[static_cast<std::size_t>(x)];
        if (!hasNormal(x, y) && above_gap != kNone) endGap({x, above_gap, 0, 1, y + 1 - above_gap});
        above_gap = y;
      }
    });
  }

  // From a pixel to the one n steps along a row or column.
  struct Pair {
    int x, y, dx, dy, n;
    int xAt(int k) const { return x + k * dx; }
    int yAt(int k) const { return y + k * dy; }
  };

  void endGap(const Pair& pair) {
    if (pair.n - 1 <= thresholds_.max_gap && turns(pair.x, pair.y, pair.xAt(pair.n), pair.yAt(pair.n))) addTurn(pair);
  }

  // Normals turn where the pixels begin to disagree with the one side's plane; the crease is where the planes of both
  // sides meet.
  void addTurn(const Pair& pair) {
    const Side one = sideOf(pair, 0, -1), other = sideOf(pair, pair.n, 1);
    const float meet =
        (other.inverse - other.slope * static_cast<float>(pair.n) - one.inverse) / (one.slope - other.slope);
    const float middle = 0.5F * static_cast<float>(pair.n);
    if (!(std::abs(meet - middle) <= middle + static_cast<float>(thresholds_.max_gap))) return;
    const int k = static_cast<int>(std::lround(meet));
    if (!isInside(pair.xAt(k), pair.yAt(k)) || jumps(pair, std::min(k, 0), std::max(k, pair.n))) return;
    if (!(*inverse_.at(pair.xAt(k), pair.yAt(k)) > 0)) return;
    turns_.addStrong(pair.x, pair.y);
    creases_.push_back({pair.x, pair.y, pair.xAt(k), pair.yAt(k)});
  }

  // What a plane says of the inverse depth along a pair: at a pixel of it, and by how much it grows with each step.
  struct Side {
    float inverse, slope;
  };

  // The mean of the pixels from the k-th on, away from the other side, as the plane has them at the k-th.
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

  // Whether there is a jump in depth among the pixels from `first` to `last` of a pair's line.
  bool jumps(const Pair& pair, int first, int last) const {
    for (int k = first; k <= last; ++k) {
      if ((labels_[index(pair.xAt(k), pair.yAt(k))] & (kOccluding | kOccluded)) != 0) return true;
    }
    return false;
  }

  const planes::InverseDepth& inverse_;
  const Pinhole& camera_;
  const NormalImage& normals_;
  const CreaseThresholds& thresholds_;
  float least_, noise_;
  std::uint8_t* labels_;
  Candidates turns_;
  std::vector<Crease> creases_;
  std::vector<int> before_gap_;  // of each column: the row above the gap that we are in
};

}  // namespace

void markCreases(const planes::InverseDepth& inverse, const Pinhole& camera, const NormalImage& normals,
                 const CreaseThresholds& thresholds, std::uint8_t* labels) {
  CreaseMarking(inverse, camera, normals, thresholds, labels).mark();
}

}  // namespace omnimapper::perception::edges

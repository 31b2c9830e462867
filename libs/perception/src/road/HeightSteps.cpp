#include "HeightSteps.h"

#include <algorithm>
#include <cmath>

#include "LineDifferences.h"

namespace omnimapper::perception::road {

namespace {

// Share of the threshold: a step that exceeds the threshold somewhere is followed as long as it exceeds this share.
constexpr double kFaint = 0.6;
constexpr int kMostTurn = 1;                        // largest change of direction from one block of a step to the next
constexpr double kLeastDiscontinuity = 0.5;         // share of the difference that is not a slope
constexpr double kMargin = 1, kMostHalfWidth = 14;  // [px] margin and limit of a step's half width
constexpr int kBlock = LineDifferences::kBlock;

using Difference = LineDifferences::Difference;

float sizeOf(const Difference& difference) {
  return std::abs(difference.mean) / difference.deviation;
}

class Steps {
 public:
  Steps(const LocalGround& ground, double block_sigma, double deviations)
      : ground_(ground),
        blocks_(ground),
        size_(static_cast<std::size_t>(blocks_.columns) * static_cast<std::size_t>(blocks_.rows)),
        best_(size_),
        is_ridge_(size_, 0) {
    mask.resize(ground.offs.size(), 0);
    for (int d = 0; d < LineDirection::kCount; ++d) differences_.push_back(blocks_.across(LineDirection::of(d)));
    for (std::size_t i = 0; i < size_; ++i) best_[i] = bestOf(i);
    const auto threshold = static_cast<float>(deviations * block_sigma / ground.step);
    findRidges(static_cast<float>(kFaint) * threshold);
    for (int y = 0; y < blocks_.rows; ++y) {
      for (int x = 0; x < blocks_.columns; ++x) {
        const std::size_t i = blocks_.index(x, y);
        if (is_ridge_[i] != 0 && best_[i].size >= threshold) maskStep(x, y);
      }
    }
  }

  std::vector<std::uint8_t> mask;

 private:
  struct Best {
    float size = 0;  // of a difference, in steps of the ground, scaled to the deviation of one block
    int direction = 0;
  };
  struct Block {
    int x, y;
  };

  Best bestOf(std::size_t i) const {
    Best best;
    for (int d = 0; d < LineDirection::kCount; ++d) {
      const float size = sizeOf(differences_[static_cast<std::size_t>(d)][i]);
      if (size > best.size) best = {size, d};
    }
    return best;
  }

  const Difference& differenceAt(int x, int y, int direction) const {
    return differences_[static_cast<std::size_t>(direction)][blocks_.index(x, y)];
  }

  void findRidges(float least) {
    for (int y = 1; y + 1 < blocks_.rows; ++y) {
      for (int x = 1; x + 1 < blocks_.columns; ++x) {
        const std::size_t i = blocks_.index(x, y);
        is_ridge_[i] = best_[i].size >= least && isRidge(x, y, best_[i]);
      }
    }
  }

  // Whether the difference is the largest across the line, and a discontinuity rather than a slope: planes fitted
  // across a step or a bend of the ground leave slopes beside it.
  bool isRidge(int x, int y, const Best& best) const {
    const LineDirection line = LineDirection::of(best.direction);
    const auto dx = static_cast<int>(std::lround(-line.y)), dy = static_cast<int>(std::lround(line.x));
    if (sizeOf(differenceAt(x + dx, y + dy, best.direction)) > best.size ||
        sizeOf(differenceAt(x - dx, y - dy, best.direction)) > best.size)
      return false;
    const auto difference = static_cast<double>(differenceAt(x, y, best.direction).mean);
    return blocks_.discontinuityAt(x, y, line) / difference >= kLeastDiscontinuity;
  }

  // Masks the whole step that a block is part of; each block is part of one step only.
  void maskStep(int x, int y) {
    std::vector<Block> left{{x, y}};
    is_ridge_[blocks_.index(x, y)] = 0;
    while (!left.empty()) {
      const Block block = left.back();
      left.pop_back();
      setMask(block);
      // Ridges are never at the border.
      for (int v = block.y - 1; v <= block.y + 1; ++v) {
        for (int u = block.x - 1; u <= block.x + 1; ++u) {
          if (!goesOn(blocks_.index(block.x, block.y), blocks_.index(u, v))) continue;
          is_ridge_[blocks_.index(u, v)] = 0;
          left.push_back({u, v});
        }
      }
    }
  }

  bool goesOn(std::size_t from, std::size_t to) const {
    if (is_ridge_[to] == 0) return false;
    const int turn = std::abs(best_[to].direction - best_[from].direction);
    return std::min(turn, LineDirection::kCount - turn) <= kMostTurn;
  }

  void setMask(const Block& block) {
    const LineDirection line = LineDirection::of(best_[blocks_.index(block.x, block.y)].direction);
    const double half_length = 0.5 * kBlock + 1, half_width = halfWidthOf(block, line);
    const double x0 = LineDifferences::middleOf(block.x), y0 = LineDifferences::middleOf(block.y);
    const int reach = static_cast<int>(half_width + half_length) + 1;
    const int x_end = std::min(ground_.width, kBlock * (block.x + 1) + reach);
    for (int y = std::max(0, kBlock * block.y - reach); y < std::min(ground_.height, kBlock * (block.y + 1) + reach);
         ++y) {
      for (int x = std::max(0, kBlock * block.x - reach); x < x_end; ++x) {
        const double dx = x - x0, dy = y - y0;
        if (std::abs(dx * line.x + dy * line.y) <= half_length && std::abs(dy * line.x - dx * line.y) <= half_width)
          mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(ground_.width) + static_cast<std::size_t>(x)] = 1;
      }
    }
  }

  // Half width [px] of a step at a block. An upright face between both heights hides as many rows as 1/z of the ground
  // takes to change by the same difference.
  double halfWidthOf(const Block& block, const LineDirection& line) const {
    const auto& plane = ground_.planeAt(kBlock * block.x, kBlock * block.y);
    const double slope = plane ? plane->b : 0;  // of 1/z, per pixel downwards
    if (!(slope > 0)) return kMargin;
    const int direction = best_[blocks_.index(block.x, block.y)].direction;
    const auto difference = static_cast<double>(std::abs(differenceAt(block.x, block.y, direction).mean));
    const double face = difference * ground_.step / slope;
    return std::min(kMostHalfWidth, 0.5 * face * std::abs(line.x) + kMargin);
  }

  const LocalGround& ground_;
  LineDifferences blocks_;
  std::size_t size_;                                  // in blocks
  std::vector<std::vector<Difference>> differences_;  // for each direction
  std::vector<Best> best_;
  std::vector<std::uint8_t> is_ridge_;  // 1 where a block exceeds those beside it and is not yet in the mask
};

}  // namespace

std::vector<std::uint8_t> findHeightSteps(const LocalGround& ground, double block_sigma, double deviations) {
  return Steps(ground, block_sigma, deviations).mask;
}

}  // namespace omnimapper::perception::road

#include "LineDifferences.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace omnimapper::perception::road {

namespace {

constexpr int kFewest = 4;                              // known pixels of a block that counts
constexpr int kHalfLength = 9;                          // [blocks] of a line
constexpr int kFewestBlocks = 5;                        // on each side of a line
constexpr int kBorder = kHalfLength + 3;                // [blocks] around the image, without values
constexpr std::array<double, 2> kRowsBeside{1.6, 2.6};  // [blocks] from the line: near steps are wider than a block
constexpr int kNearestFitted = 2, kFarthestFitted = 6;  // [blocks] from the line, of the blocks that are fitted
constexpr double kMostMore = 4 * LocalGround::kSteps;
// The value of a block that counts is kOne + its mean: a sum of values is kOne times the number of blocks, plus the sum
// of their means, which stays below half of kOne.
constexpr int kOneBits = 20;
constexpr std::int32_t kOne = 1 << kOneBits;
static_assert(planes::kCell % LineDifferences::kBlock == 0, "a block lies in one cell");

// Correction of a block's distances from the plane of its cell to distances from the ground between cells. At the
// borders of cells their planes have a discontinuity where the ground has none.
std::int32_t fromOneCell(const LocalGround& ground, int column, int row) {
  const double x = LineDifferences::middleOf(column), y = LineDifferences::middleOf(row);
  const auto& plane = ground.planeAt(column * LineDifferences::kBlock, row * LineDifferences::kBlock);
  const double more = plane->at(x - ground.camera.cx, y - ground.camera.cy) - ground.between(x, y);
  return static_cast<std::int32_t>(std::clamp(more / ground.step, -kMostMore, kMostMore));
}

std::int32_t valueOf(const LocalGround& ground, int column, int row) {
  constexpr int kBlock = LineDifferences::kBlock;
  int sum = 0, known = 0;
  for (int y = row * kBlock; y < (row + 1) * kBlock; ++y) {
    const std::int16_t* offs = ground.offs.data() + static_cast<std::ptrdiff_t>(y) * ground.width;
    for (int x = column * kBlock; x < (column + 1) * kBlock; ++x) {
      if (std::abs(offs[x]) >= LocalGround::kFarthest) continue;  // unknown, or not ground
      sum += offs[x];
      ++known;
    }
  }
  return known < kFewest ? 0 : kOne + sum / known + fromOneCell(ground, column, row);
}

std::int32_t countOf(std::int32_t sum) {
  return (sum + kOne / 2) >> kOneBits;
}

LineDifferences::Difference difference(std::int32_t beyond, std::int32_t before) {
  const std::int32_t n = countOf(beyond), m = countOf(before);
  if (n < kFewestBlocks || m < kFewestBlocks) return {};
  const auto in_n = 1 / static_cast<float>(n), in_m = 1 / static_cast<float>(m);
  return {static_cast<float>(beyond - n * kOne) * in_n - static_cast<float>(before - m * kOne) * in_m,
          std::sqrt(in_n + in_m)};
}

}  // namespace

LineDirection LineDirection::of(int number) {
  const double angle = M_PI * number / kCount;
  return {std::cos(angle), std::sin(angle)};
}

LineDifferences::LineDifferences(const LocalGround& ground)
    : columns(ground.width / kBlock), rows(ground.height / kBlock), stride_(columns + 2 * kBorder) {
  values_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows + 2 * kBorder), 0);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) values_[at(x, y)] = valueOf(ground, x, y);
  }
}

std::vector<LineDifferences::Difference> LineDifferences::across(const LineDirection& line) const {
  std::vector<Difference> differences(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto beyond = places(line, 1), before = places(line, -1);
  std::vector<std::int32_t> sums_beyond(static_cast<std::size_t>(columns)), sums_before(sums_beyond);
  for (int y = 0; y < rows; ++y) {
    sumRow(y, beyond, sums_beyond);
    sumRow(y, before, sums_before);
    for (int x = 0; x < columns; ++x) {
      const auto i = static_cast<std::size_t>(x);
      differences[index(x, y)] = difference(sums_beyond[i], sums_before[i]);
    }
  }
  return differences;
}

double LineDifferences::discontinuityAt(int x, int y, const LineDirection& line) const {
  Eigen::Matrix4d squares = Eigen::Matrix4d::Zero();
  Eigen::Vector4d products = Eigen::Vector4d::Zero();
  for (int across = -kFarthestFitted; across <= kFarthestFitted; ++across) {
    if (std::abs(across) < kNearestFitted) continue;
    for (int along = -kHalfLength; along <= kHalfLength; ++along) {
      const std::int32_t value = values_[at(x, y) + static_cast<std::size_t>(place(line, along, across))];
      if (value == 0) continue;
      const Eigen::Vector4d unknowns(1, along, across, across > 0 ? 0.5 : -0.5);  // level, slopes, discontinuity
      squares += unknowns * unknowns.transpose();
      products += static_cast<double>(value - kOne) * unknowns;
    }
  }
  // If only one row of blocks is known on each side, a discontinuity cannot be distinguished from a slope.
  constexpr double kNothing = 1e-6;
  const Eigen::LDLT<Eigen::Matrix4d> root(squares);
  return root.vectorD().minCoeff() > kNothing ? root.solve(products).w() : 0;
}

std::size_t LineDifferences::at(int x, int y) const {
  return static_cast<std::size_t>((y + kBorder) * stride_ + x + kBorder);
}

// Offset in values_ of a block from the middle of a line.
std::ptrdiff_t LineDifferences::place(const LineDirection& line, int along, double across) const {
  const auto x = std::lround(along * line.x - across * line.y), y = std::lround(along * line.y + across * line.x);
  return y * stride_ + x;
}

// Offsets of all blocks on one side of a line.
std::vector<std::ptrdiff_t> LineDifferences::places(const LineDirection& line, int side) const {
  std::vector<std::ptrdiff_t> all;
  for (int along = -kHalfLength; along <= kHalfLength; ++along) {
    for (const double row : kRowsBeside) all.push_back(place(line, along, side * row));
  }
  return all;
}

void LineDifferences::sumRow(int y, const std::vector<std::ptrdiff_t>& places, std::vector<std::int32_t>& sums) const {
  std::fill(sums.begin(), sums.end(), 0);
  for (const std::ptrdiff_t place : places) {
    const std::int32_t* values = values_.data() + static_cast<std::ptrdiff_t>(at(0, y)) + place;
    for (std::size_t x = 0; x < sums.size(); ++x) sums[x] += values[x];
  }
}

}  // namespace omnimapper::perception::road

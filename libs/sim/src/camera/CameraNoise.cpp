#include "CameraNoise.h"

#include <algorithm>
#include <utility>

namespace omnimapper::sim {

namespace {

// Replaces each value by the sum of the `reach` values of its row from it on; the last reach - 1 of a row are not valid
// then.
void sumAlongRows(std::vector<float>& grid, int width, int height, int reach) {
  for (int row = 0; row < height; ++row) {
    float* line = &grid[static_cast<std::size_t>(row) * width];
    float sum = 0;
    for (int i = 0; i < reach - 1; ++i) sum += line[i];
    for (int i = 0; i + reach <= width; ++i) {
      sum += line[i + reach - 1];
      sum -= std::exchange(line[i], sum);
    }
  }
}

// Does the same down the columns, all of them at once.
void sumDownColumns(std::vector<float>& grid, int width, int height, int reach) {
  std::vector<float> sums(width, 0.0f);
  const auto line = [&](int row) { return &grid[static_cast<std::size_t>(row) * width]; };
  for (int row = 0; row < reach - 1; ++row) {
    for (int i = 0; i < width; ++i) sums[i] += line(row)[i];
  }
  for (int row = 0; row + reach <= height; ++row) {
    float* leaving = line(row);
    const float* entering = line(row + reach - 1);
    for (int i = 0; i < width; ++i) {
      const float sum = sums[i] + entering[i];
      sums[i] = sum - leaving[i];
      leaving[i] = sum;
    }
  }
}

}  // namespace

std::vector<float> smoothNoise(int width, int height, int reach, Random& random) {
  reach = std::max(reach, 1);
  const int margin = 2 * (reach - 1), wide = width + margin, high = height + margin;
  std::vector<float> grid(static_cast<std::size_t>(wide) * high);
  for (float& value : grid) value = quickGaussian(random);
  if (reach > 1) {
    for (int pass = 0; pass < 2; ++pass) sumAlongRows(grid, wide, high, reach);
    for (int pass = 0; pass < 2; ++pass) sumDownColumns(grid, wide, high, reach);
  }
  // Two passes give triangular weights 1 .. reach .. 1; the sum of their squares is the variance along one axis.
  const double variance = reach * (2.0 * reach * reach + 1) / 3.0;
  std::vector<float> noise(static_cast<std::size_t>(width) * height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      noise[static_cast<std::size_t>(row) * width + column] =
          static_cast<float>(grid[static_cast<std::size_t>(row) * wide + column] / variance);
    }
  }
  return noise;
}

}  // namespace omnimapper::sim

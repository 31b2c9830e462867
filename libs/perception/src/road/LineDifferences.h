#pragma once

#include <cstdint>
#include <vector>

#include "LocalGround.h"

namespace omnimapper::perception::road {

/// Unit vector along a line in the image, x right and y down. The direction across the line is (-y, x).
struct LineDirection {
  static constexpr int kCount = 16;  ///< directions over half a turn
  double x, y;

  static LineDirection of(int number);
};

/// Measures how much nearer the pixels on one side of a straight line are than those on the other side, relative to the
/// fitted ground. Pixels are averaged over blocks of 4 x 4, about the area that shares one error of a stereo camera.
class LineDifferences {
 public:
  static constexpr int kBlock = 4;  ///< [px]
  /// Coordinate [px] of a block's middle, along either axis.
  static double middleOf(int block) { return kBlock * block + 0.5 * (kBlock - 1); }

  explicit LineDifferences(const LocalGround& ground);

  const int columns, rows;  ///< numbers of blocks
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }

  struct Difference {
    float mean = 0;       ///< in LocalGround::step: the side across the line, minus the other side
    float deviation = 1;  ///< standard deviation of the mean if that of a block is 1
  };
  /// Differences at the line through each block, row by row; 0 where too few blocks are known.
  std::vector<Difference> across(const LineDirection& line) const;
  /// Discontinuity at the line through a block, in LocalGround::step, by least squares together with a steady slope; 0
  /// where too little is known to distinguish the two.
  double discontinuityAt(int x, int y, const LineDirection& line) const;

 private:
  std::size_t at(int x, int y) const;
  std::ptrdiff_t place(const LineDirection& line, int along, double across) const;
  std::vector<std::ptrdiff_t> places(const LineDirection& line, int side) const;
  void sumRow(int y, const std::vector<std::ptrdiff_t>& places, std::vector<std::int32_t>& sums) const;

  int stride_;
  std::vector<std::int32_t> values_;  // of each block, with a border: whether it counts, and its mean, in one number
};

}  // namespace omnimapper::perception::road

#pragma once

#include <cstdint>
#include <vector>

#include "LocalGround.h"

namespace omnimapper::perception::road {

/// Of a line in the image, x right and y down: along the line; across it is (-y, x).
struct LineDirection {
  static constexpr int kCount = 16;  ///< over half a turn
  double x, y;

  static LineDirection of(int number);
};

/// By how much the ground, averaged over blocks of 4 x 4 pixels, is nearer on one side of straight lines than on the
/// other. A block is about what shares one error of a stereo camera.
class LineDifferences {
 public:
  static constexpr int kBlock = 4;  ///< [px]
  /// [px] of a block's middle, along either axis.
  static double middleOf(int block) { return kBlock * block + 0.5 * (kBlock - 1); }

  explicit LineDifferences(const LocalGround& ground);

  const int columns, rows;  ///< of blocks
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }

  struct Difference {
    float mean = 0;       ///< in steps of the ground: what is across the line exceeds what is on its other side
    float deviation = 1;  ///< of that, if each block's is 1
  };
  /// Of the line through each block, row by row; 0 where too little is known.
  std::vector<Difference> across(const LineDirection& line) const;
  /// In steps of the ground: the jump at the line through that block, by least squares beside a steady slope;
  /// 0 where too little is known to tell them apart.
  double jumpAt(int x, int y, const LineDirection& line) const;

 private:
  std::size_t at(int x, int y) const;
  std::ptrdiff_t place(const LineDirection& line, int along, double across) const;
  std::vector<std::ptrdiff_t> places(const LineDirection& line, int side) const;
  void sumRow(int y, const std::vector<std::ptrdiff_t>& places, std::vector<std::int32_t>& sums) const;

  int stride_;
  std::vector<std::int32_t> values_;  // of each block, with a border: its number, 1 or 0, and its mean in one
};

}  // namespace omnimapper::perception::road

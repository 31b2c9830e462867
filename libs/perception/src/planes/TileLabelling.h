#pragma once

#include <cstdint>

namespace omnimapper::perception::planes {

constexpr int kMostCandidates = 6;

/// The planes that the pixels of a cell may lie on.
struct TileCandidates {
  int count = 0;
  float a[kMostCandidates], b[kMostCandidates];
  float c[kMostCandidates];  ///< 1/z at the cell's upper left pixel
  std::int32_t label[kMostCandidates];
  /// [j][k], which of the candidates j < k wins where both fit: 1, the one nearer to the sensor; -1, the farther one;
  /// 0, the one that fits better.
  float nearer_wins[kMostCandidates][kMostCandidates];
};

/// Labels each of kCell x kCell pixels with a candidate within `tolerance` [1/m], or with 0 where none fits. `labels`
/// has the stride of `values`.
void labelTile(const float* values, int stride, const TileCandidates& candidates, float tolerance,
               std::uint16_t* labels);

}  // namespace omnimapper::perception::planes

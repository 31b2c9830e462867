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
  /// Who wins where both k and an earlier j fit: 1, k where it is nearer to the sensor; -1, k where it is farther; 0,
  /// the one that fits better.
  float nearer_wins[kMostCandidates][kMostCandidates];
};

/// Labels kCell x kCell pixels with the candidate within `tolerance` [1/m], or 0. `labels` has the stride of `values`.
void labelTile(const float* values, int stride, const TileCandidates& candidates, float tolerance,
               std::uint16_t* labels);

}  // namespace omnimapper::perception::planes

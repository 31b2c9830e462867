#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Cut.h"
#include "FreeSpace.h"

namespace omnimapper::building {

/// What a piece of free space between cuts, or several together, are like.
struct Piece {
  double area = 0;       ///< [m^2]
  double clearance = 0;  ///< [m] radius of the largest circle in it
  double walls = 0;      ///< number of its cells at measured obstacles
  double unseen = 0;     ///< number of its cells at what has not been seen

  /// Share of the border behind which nothing has been seen.
  double openness() const { return walls + unseen > 0 ? unseen / (walls + unseen) : 0; }
  void add(const Piece& other);
};

/// Free space, cut at all candidates.
struct Pieces {
  cv::Mat number;             ///< CV_32S, of each cell, from 1 on; 0 on cuts and where space is not free
  std::vector<Piece> pieces;  ///< by number; the first is not used
};

Pieces cutIntoPieces(const FreeSpace& space, const std::vector<Cut>& cuts);

/// Notes in each cut which pieces are on both sides of it, and how much free space is close to it.
void lookAround(const FreeSpace& space, const Pieces& pieces, std::vector<Cut>& cuts);

/// Distance between places of Cut::opening and Cut::beyond [cells].
double sampleStep(const FreeSpace& space);

}  // namespace omnimapper::building

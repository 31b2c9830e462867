#pragma once

#include <omnimapper/building/Storey.h>

#include <optional>
#include <vector>

#include "Cut.h"
#include "DisjointSets.h"
#include "Pieces.h"

namespace omnimapper::building {

/// A cut, as far as it is between two regions.
struct Border {
  int left = 0, right = 0;  ///< regions, by the number of one of their pieces
  double width = 0;         ///< [m]
  double from = 0, to = 0;  ///< its first and last place on the cut [cells from Cut::from]
  double score = 0;         ///< above 0: it separates two rooms
  DoorEvidence evidence;
};

/// Regions, which are pieces joined across the cuts that separate no rooms.
class Regions {
 public:
  /// Joins pieces across the cut with the lowest score until all that are left have positive scores and no region that
  /// has a border is smaller than SegmentationOptions::least_area.
  Regions(const FreeSpace& space, const Pieces& pieces, const std::vector<Cut>& cuts,
          const SegmentationOptions& options);

  int regionOf(int piece) { return sets_.find(piece); }
  const Piece& region(int number) const { return pieces_[number]; }
  /// What is left of the cuts: one entry for each cut, in which only borders between regions are.
  const std::vector<std::vector<Border>>& borders() const { return borders_; }

 private:
  void findBorders(std::size_t cut);
  std::optional<Border> weakest() const;
  void join(const Border& border);
  Border judged(const Cut& cut, Border border);

  const std::vector<Cut>& cuts_;
  const SegmentationOptions& options_;
  double cell_, step_;  // [m], [cells]
  std::vector<Piece> pieces_;
  DisjointSets sets_;
  std::vector<std::vector<Border>> borders_;
};

}  // namespace omnimapper::building

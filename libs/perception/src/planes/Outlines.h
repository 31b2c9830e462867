#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/PlaneRegion.h>

#include <cstdint>
#include <vector>

namespace omnimapper::perception::planes {

/// A closed line around pixels of one label, or around what they enclose.
struct TracedLine {
  std::uint16_t label = 0;
  int area = 0;  ///< pixels enclosed; negative around a hole
  std::vector<PixelCorner> corners;
};

/// Traces the edges between labels, 4-connected, for each label but 0. `runs` are the runs of equal labels,
/// each in one piece or several. Lines around fewer than `min_hole` pixels of a hole are left out.
std::vector<TracedLine> traceOutlines(const std::vector<std::uint16_t>& labels, int width, int height,
                                      const std::vector<PixelRun>& runs, int min_hole);

/// Which corners of a closed line are enough for it to within `tolerance` [px]: geometry::keptOfLoop().
std::vector<std::size_t> cornersNeeded(const std::vector<PixelCorner>& corners, double tolerance);

}  // namespace omnimapper::perception::planes

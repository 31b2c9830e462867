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

/// Traces the edges between labels, 4-connected, for each label but 0. `runs` are the runs of equal labels;
/// one may be split into several. Holes of fewer than `min_hole` pixels are left out.
std::vector<TracedLine> traceOutlines(const std::vector<std::uint16_t>& labels, int width, int height,
                                      const std::vector<PixelRun>& runs, int min_hole);

/// Indices of the corners that keep a closed line true to within `tolerance` [px], by geometry::keptOfLoop().
std::vector<std::size_t> cornersNeeded(const std::vector<PixelCorner>& corners, double tolerance);

}  // namespace omnimapper::perception::planes

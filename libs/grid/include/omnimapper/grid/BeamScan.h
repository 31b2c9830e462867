#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace omnimapper::grid {

/// What a 2D laser saw and where it saw nothing, in the sensor's frame [m].
struct BeamScan {
  std::vector<Eigen::Vector2f> hits;    ///< ends of beams that met something, in the order of the beams
  std::vector<Eigen::Vector2f> misses;  ///< how far a beam is known to have met nothing, where it ended in no echo
};

/// The same without what is not finite.
inline BeamScan finitePart(BeamScan scan) {
  for (auto* points : {&scan.hits, &scan.misses}) {
    points->erase(std::remove_if(points->begin(), points->end(), [](const auto& point) { return !point.allFinite(); }),
                  points->end());
  }
  return scan;
}

}  // namespace omnimapper::grid

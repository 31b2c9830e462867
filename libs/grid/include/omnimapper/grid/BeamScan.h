#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace omnimapper::grid {

/// What a 2D laser saw and where it saw nothing, in the sensor's frame [m].
struct BeamScan {
  std::vector<Eigen::Vector2f> hits;    ///< ends of beams with an echo, in the order of the beams
  std::vector<Eigen::Vector2f> misses;  ///< points up to which beams without an echo are known to be free
};

/// The scan without points that are not finite.
inline BeamScan finitePart(BeamScan scan) {
  for (auto* points : {&scan.hits, &scan.misses}) {
    points->erase(std::remove_if(points->begin(), points->end(), [](const auto& point) { return !point.allFinite(); }),
                  points->end());
  }
  return scan;
}

}  // namespace omnimapper::grid

#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::matching {

/// What a 2D laser saw and where it saw nothing, in the sensor's frame [m].
struct BeamScan {
  std::vector<Eigen::Vector2f> hits;    ///< ends of beams that met something, in the order of the beams
  std::vector<Eigen::Vector2f> misses;  ///< how far a beam is known to have met nothing, where it ended in no echo
};

}  // namespace omnimapper::matching

#pragma once

#include <omnimapper/map/Map.h>

#include <cstdint>
#include <vector>

namespace omnimapper::map {

struct StampedPose {
  base::Stamp stamp;
  mrpt::poses::CPose3D map_from_base;
  std::uint16_t session = 0;
};

/// One pose for each observation of the reference sensor, a key frame or a dependent frame, in the order of key frames.
/// Between two key frames the disagreement of the continuous source with the optimized poses is spread evenly in time,
/// so that the path has no steps.
std::vector<StampedPose> denseTrajectory(const Map& map);

/// The last pose of the base: that of the newest key frame or its last dependent frame. The map must have a key frame.
mrpt::poses::CPose3D newestPose(const Map& map);

}  // namespace omnimapper::map

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

/// One pose for each observation of the reference sensor, whether at a key frame or at a dependent frame, in the order
/// of key frames. From one key frame to the next, the motion that the pose source measured differs from the motion
/// between the optimized poses. This difference is spread evenly in time over the dependent frames, so that the path
/// has no steps.
std::vector<StampedPose> denseTrajectory(const Map& map);

/// The last pose of the base: that of the newest key frame's last dependent frame or, if it has none, that of the
/// newest key frame. The map must have a key frame.
mrpt::poses::CPose3D newestPose(const Map& map);

}  // namespace omnimapper::map

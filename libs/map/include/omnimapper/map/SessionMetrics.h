#pragma once

#include <omnimapper/map/Map.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace omnimapper::map {

/// How much one session drove.
struct SessionMetrics {
  std::uint16_t number = 0;
  std::size_t key_frames = 0;
  double way = 0;      ///< [m] from key frame to key frame
  double seconds = 0;  ///< from its first observation to its last
};

/// Of every session that has a key frame, in order.
std::vector<SessionMetrics> sessionMetrics(const Map& map);

}  // namespace omnimapper::map

#pragma once

#include <omnimapper/map/Map.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace omnimapper::map {

/// How far and how long one session drove.
struct SessionMetrics {
  std::uint16_t number = 0;
  std::size_t key_frames = 0;
  double travel = 0;   ///< [m] distance travelled, from key frame to key frame
  double seconds = 0;  ///< from its first observation to its last
};

/// The metrics of every session that has a key frame, in order of sessions.
std::vector<SessionMetrics> sessionMetrics(const Map& map);

}  // namespace omnimapper::map

#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/SessionStart.h>

#include <cstdint>
#include <optional>

namespace omnimapper::mapper {

/// Section [session] of an INI: the number of the session, and its assumed start if it continues a map. This start
/// places the session until measurements connect the session to the map. If the measurements contradict the start by
/// much, the start has little effect.
struct SessionOptions {
  enum class Start {
    end,      ///< where the last session ended
    origin,   ///< at the map's origin
    pose,     ///< at the pose below
    anywhere  ///< unknown: the start is searched for in the whole map
  };
  std::optional<int> number;  ///< empty: 0 in a new map, else the one after the last of the map
  Start start = Start::end;
  double start_x = 0, start_y = 0;                                       ///< [m] in the map
  double start_yaw = 0;                                                  ///< [rad]
  double start_sigma = 1;                                                ///< [m]
  double start_angle_sigma = 30 * base::option_text::kRadiansPerDegree;  ///< [rad]

  int window_key_frames = 50;  ///< key frames in the window of a session that is localized in a map
  static const base::OptionTable<SessionOptions>& table();
  /// The start on `map`, which must have at least one key frame.
  SessionStart startOn(const map::Map& map) const;
  /// The number of the session that continues `map`, or of the first one of a map without sessions. Sessions are in
  /// order of number. Throws Error(out_of_range) if `number` is not larger than those of the sessions of the map, or if
  /// no number is left.
  std::uint16_t numberIn(const map::Map& map) const;
};

}  // namespace omnimapper::mapper

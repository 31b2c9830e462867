#pragma once

#include <omnimapper/plugin/SessionStart.h>
#include <omnimapper/plugin/View.h>

#include <optional>
#include <vector>

#include "SignSighting.h"
#include "SignTracks.h"

namespace omnimapper::plugins {

/// Where a session that nothing ties to the map yet is by the signs that it reads. A sign counts if its number, of
/// three digits or more, stands on one sign of the map alone.
class SignPlacement {
 public:
  /// By one sign in an image: the base is before it, as far as signs are read from. None if no number is known.
  static std::optional<mapper::SessionPlace> byOneSighting(const std::vector<SignSighting>& sightings,
                                                           const map::KeyFrame& frame, const SignTracks& tracks,
                                                           const mapper::View& view);
  /// By the two signs farthest from each other that the session has landmarks of, if they are as far apart in the map.
  static std::optional<mapper::SessionPlace> byTwoSigns(const SignTracks& tracks, const mapper::View& view);
};

}  // namespace omnimapper::plugins

#pragma once

#include <omnimapper/map/Places.h>
#include <omnimapper/plugin/State.h>

namespace omnimapper::derived {

/// The places that a map is queried by: the landmarks that outputs show and that have a position, those that are faces
/// of one thing as one place (joinFaces()), and the last pose of the newest session that is aligned with the map.
map::Places placesOf(const mapper::State& state);

}  // namespace omnimapper::derived

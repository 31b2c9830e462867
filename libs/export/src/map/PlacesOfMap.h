#pragma once

#include <omnimapper/map/Places.h>
#include <omnimapper/plugin/State.h>

namespace omnimapper::exports {

/// What a map answers when it is asked by name: the landmarks that outputs show and that are somewhere, and where the
/// base is at the end of the newest session that is joined to the map.
map::Places placesOf(const mapper::State& state);

}  // namespace omnimapper::exports

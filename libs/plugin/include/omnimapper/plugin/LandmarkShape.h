#pragma once

#include <omnimapper/plugin/State.h>

#include <cstddef>
#include <map>
#include <string>

namespace omnimapper::mapper {

/// How a landmark looks in the map [m], as its payload tells of its variables; its kind stands for a label that nobody
/// tells.
map::LandmarkShape shapeOf(const map::Landmark& landmark, const State& state);

/// How many landmarks there are by what a user calls them: by their label, "wall", or by the kind that it begins with,
/// "marker" of "marker 12". Those merged into another one, and those that are no longer there, are not counted.
std::map<std::string, std::size_t> countLandmarks(const State& state);

}  // namespace omnimapper::mapper

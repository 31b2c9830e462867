#pragma once

#include <omnimapper/plugin/State.h>

#include <cstddef>
#include <map>
#include <string>

namespace omnimapper::mapper {

/// The shape of a landmark in the map [m], computed by its payload from its variables. If the payload gives no label,
/// the label is the landmark's kind.
map::LandmarkShape shapeOf(const map::Landmark& landmark, const State& state);

/// The number of landmarks by label, such as "wall", or by kind if the label begins with the kind: "marker 12" counts
/// as "marker". Candidates, merged landmarks and those that are no longer there are not counted.
std::map<std::string, std::size_t> countLandmarks(const State& state);

}  // namespace omnimapper::mapper

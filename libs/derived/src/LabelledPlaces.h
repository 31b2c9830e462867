#pragma once

#include <omnimapper/map/Labels.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/map/Places.h>

#include <vector>

namespace omnimapper::derived {

/// Adds what people named (map::Labels) to the places of a map. A landmark with a name has it as the property "name".
/// Several landmarks of one name are one more place, a "region": the convex hull of all of them, seen from above
/// (thesis 6.2.2.1). A name of a place, or of a landmark that is not among the places, is a "place" of one point. The
/// ids of regions and places are those of no landmarks.
void addLabels(const map::Map& map, std::vector<map::Place>& places);

}  // namespace omnimapper::derived

#pragma once

#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/map/Places.h>
#include <omnimapper/surfaces/ThingsOfFaces.h>

#include <vector>

namespace omnimapper::derived {

/// A landmark with surfaces as a surface of that class, in the frame of the map; its id is to be set.
surfaces::Surface surfaceOf(const ShapedLandmark& shaped);

/// The things whose faces are landmarks (surfaces::thingsOf()); faces are indices of `landmarks`. Landmarks that were
/// moved, or that have no surfaces, are faces of none. None in a map whose z axis is not up.
std::vector<surfaces::Thing> thingsOf(const std::vector<ShapedLandmark>& landmarks, const map::Map& map);

/// Replaces the places of the faces of each thing that has several by one place. It has the id of the first face, the
/// box of the thing as extent, the names and counts of all faces, and the properties "length", "width", "height" [m],
/// "direction" of the longer side [deg] and map::kParts, the ids of the faces. `landmarks` are those of the things.
void joinFaces(const std::vector<surfaces::Thing>& things, const std::vector<ShapedLandmark>& landmarks,
               std::vector<map::Place>& places);

}  // namespace omnimapper::derived

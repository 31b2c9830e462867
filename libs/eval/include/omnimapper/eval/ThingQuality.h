#pragma once

#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/surfaces/ThingsOfFaces.h>

#include <cstddef>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// How the things of a map (surfaces::thingsOf()) compare with the true bodies whose faces they have.
struct ThingQuality {
  std::vector<surfaces::Thing> things;  ///< of the drawn surfaces of the map
  std::size_t bodies = 0;               ///< furniture that was not moved and of which a thing of the map has a face
  std::size_t whole = 0;                ///< ... all of whose faces are of one thing, which has no face of another body
  std::size_t split = 0;                ///< ... whose faces are of several things
  std::size_t mixed = 0;                ///< things with faces of several bodies
  std::size_t right_class = 0;          ///< whole ones whose thing has the class of most of the body's seen area
  /// Of whole ones of which two sides or a top were seen: by how much the longer and the shorter side of the box
  /// differ from those of the body [m], two for each.
  std::vector<double> size_errors;
};

/// The map must be in the frame of the truth. `quality`: the result of judgeMap() for both.
ThingQuality judgeThings(const MapQuality& quality, const surfaces::SurfaceSet& map, const surfaces::SurfaceSet& truth);

/// Lines of text for a terminal.
std::string table(const ThingQuality& quality);

}  // namespace omnimapper::eval

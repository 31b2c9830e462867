#pragma once

#include <omnimapper/sim_world/World.h>

#include <string>

namespace omnimapper::sim {

/// Dictionaries of ArUco markers, as OpenCV names them.
enum class MarkerDictionary { dict_4x4_50, dict_6x6_250 };
/// "4x4_50", "6x6_250"; throws base::Error(out_of_range) that lists them.
MarkerDictionary markerDictionaryOf(const std::string& name);

struct MarkerSpec {
  std::string name;  ///< of its body and surface
  MarkerDictionary dictionary = MarkerDictionary::dict_4x4_50;
  int id = 0;
  double side = 0.15;             ///< of the black square [m]
  geometry::Se3 map_from_marker;  ///< frame as Sign's, origin in the middle of the front
};

constexpr double kMarkerThickness = 0.004;  ///< its back is this far behind its front [m]

struct MadeMarker {
  Body body;  ///< surface "<name>" is the front, kind marker: the black square in a white margin, 1.4 sides wide in all
  Marker marker;
};

/// Throws base::Error(out_of_range) for an id the dictionary lacks or a side that is not positive.
MadeMarker makeMarker(const MarkerSpec& spec);

}  // namespace omnimapper::sim

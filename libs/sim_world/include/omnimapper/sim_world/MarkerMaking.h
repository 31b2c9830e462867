#pragma once

#include <omnimapper/sim_world/World.h>

#include <string>

namespace omnimapper::sim {

/// Dictionaries of ArUco markers, as OpenCV names them.
enum class MarkerDictionary { dict_4x4_50, dict_6x6_250 };
/// The dictionary named "4x4_50" or "6x6_250". For another name, throws base::Error(out_of_range), which lists these.
MarkerDictionary markerDictionaryOf(const std::string& name);

struct MarkerSpec {
  std::string name;  ///< of its body and surface
  MarkerDictionary dictionary = MarkerDictionary::dict_4x4_50;
  int id = 0;
  double side = 0.15;             ///< of the black square [m]
  geometry::Se3 map_from_marker;  ///< frame as Sign's, with the origin in the middle of the front
};

constexpr double kMarkerThickness = 0.004;  ///< a marker's back is this far behind its front [m]

struct MadeMarker {
  /// Surface "<name>", of kind marker, is the front: the black square with a white margin. With the margin, the front
  /// is 1.4 times as wide as the square.
  Body body;
  Marker marker;
};

/// Throws base::Error(out_of_range) for an id the dictionary lacks or a side that is not positive.
MadeMarker makeMarker(const MarkerSpec& spec);

}  // namespace omnimapper::sim

#pragma once

#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

struct GeoJsonInput {
  const mapper::View& view;
  std::string title;
  bool metres = false;  ///< write metres of the map even if its place on the earth is known
  bool trajectory = true;
};

/// A FeatureCollection by RFC 7946: landmarks as seen from above, then the trajectory of each session. Coordinates are
/// longitude and latitude (WGS84) if the map's place on the earth is known; else x and y of the map [m], which the RFC
/// allows by agreement.
std::string encodeGeoJson(const GeoJsonInput& input);

}  // namespace omnimapper::plugins

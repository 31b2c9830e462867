#pragma once

#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

#include "plan/LandmarkShapes.h"

namespace omnimapper::exports {

struct GeoJsonInput {
  const mapper::View& view;
  std::string title;
  bool metres = false;  ///< of the map, even if its place on the earth is known
  bool trajectory = true;
};

/// A FeatureCollection as RFC 7946 has it: landmarks as seen from above, then the way of each session. Longitude and
/// latitude (WGS84) if the map knows its place on the earth; else x and y of the map [m], which the RFC leaves to those
/// who agree on it.
std::string encodeGeoJson(const GeoJsonInput& input);

}  // namespace omnimapper::exports

#include <mrpt/topography/conversions.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PlaceOnEarth.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SavedVariable.h>

#include <cmath>
#include <sstream>
#include <string_view>

namespace omnimapper::mapper {

namespace {

constexpr std::string_view kOldMark = "place on earth";  // at the end of a plugin's state that held a place
constexpr std::size_t kBytes = 6 + 3 * 8;                // id, latitude, longitude, altitude

bool heldPlace(const std::string& bytes) {
  return bytes.size() == kBytes + kOldMark.size() && std::string_view(bytes).substr(kBytes) == kOldMark;
}

bool isOnEarth(const Geodetic& place) {
  return std::abs(place.latitude) <= 90 && std::abs(place.longitude) <= 180 && std::isfinite(place.altitude);
}

// Whether the graph has the variable, and it is a pose.
bool isPose(base::VariableId id, const graph::Graph& graph) {
  if (!graph.contains(id)) return false;
  const auto kind = graph.variable(id).kind->kind();
  return kind == graph::se2()->kind() || kind == graph::se3()->kind();
}

PlaceOnEarth placeFrom(const std::string& bytes) {
  std::istringstream in(bytes);
  PlaceOnEarth place;
  place.map_from_enu = graph::readId<base::VariableId>(in);
  for (double* number : {&place.origin.latitude, &place.origin.longitude, &place.origin.altitude})
    *number = graph::readDouble(in);
  return place;
}

}  // namespace

std::string PlaceOnEarth::toBytes() const {
  std::ostringstream out;
  writeVariableId(out, map_from_enu);
  for (const double number : {origin.latitude, origin.longitude, origin.altitude}) graph::writeDouble(out, number);
  return out.str();
}

PlaceOnEarth PlaceOnEarth::fromSection(const map::MapSection& section) {
  expectVersion(section, kLayerVersion);
  const auto place = section.bytes.size() == kBytes ? placeFrom(section.bytes) : PlaceOnEarth{};
  const bool is_whole = section.bytes.size() == kBytes && isOnEarth(place.origin);
  if (!is_whole) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "map file, section \"" + section.name + "\": it holds no place on earth: the file is damaged");
  }
  return place;
}

const PlaceOnEarth* placeOnEarth(const State& state) {
  const auto* place = state.map.layers.find<PlaceOnEarth>();
  return place && isPose(place->map_from_enu, state.graph) ? place : nullptr;
}

void adoptPlaceOnEarth(map::Layers& layers, const graph::Graph& graph) {
  if (layers.find(PlaceOnEarth::kLayer)) return;
  for (const auto& [name, layer] : layers) {
    if (!dynamic_cast<const map::RawLayer*>(layer.get())) continue;
    const std::string bytes = layer->bytes();
    if (!heldPlace(bytes)) continue;
    const auto place = placeFrom(bytes);
    if (!isPose(place.map_from_enu, graph) || !isOnEarth(place.origin)) continue;
    layers.set(place);
    return;
  }
}

EarthFrame::EarthFrame(const PlaceOnEarth& place, const State& state)
    : origin_(place.origin), enu_from_map_(-poseOf(state.graph, place.map_from_enu)) {}

Geodetic EarthFrame::operator()(const Eigen::Vector3d& point_in_map) const {
  mrpt::math::TPoint3D enu;
  enu_from_map_.composePoint({point_in_map.x(), point_in_map.y(), point_in_map.z()}, enu);
  const mrpt::topography::TGeodeticCoords origin(origin_.latitude, origin_.longitude, origin_.altitude);
  mrpt::topography::TGeocentricCoords geocentric;
  mrpt::topography::ENUToGeocentric(enu, origin, geocentric, mrpt::topography::TEllipsoid::Ellipsoid_WGS84());
  mrpt::topography::TGeodeticCoords found;
  mrpt::topography::geocentricToGeodetic(geocentric, found, mrpt::topography::TEllipsoid::Ellipsoid_WGS84());
  return {found.lat.decimal_value, found.lon.decimal_value, found.height};
}

}  // namespace omnimapper::mapper

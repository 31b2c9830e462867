#include <mrpt/topography/conversions.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/plugin/PlaceOnEarth.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SavedVariable.h>

#include <sstream>
#include <string_view>

namespace omnimapper::mapper {

namespace {

constexpr std::string_view kMark = "place on earth";

bool isPlace(const std::string& bytes) {
  constexpr std::size_t kSize = 6 + 3 * 8 + kMark.size();
  return bytes.size() == kSize && std::string_view(bytes).substr(kSize - kMark.size()) == kMark;
}

}  // namespace

std::string writePlace(const PlaceOnEarth& place) {
  std::ostringstream out;
  writeVariableId(out, place.map_from_enu);
  for (const double number : {place.origin.latitude, place.origin.longitude, place.origin.altitude})
    graph::writeDouble(out, number);
  out << kMark;
  return out.str();
}

std::optional<PlaceOnEarth> placeOnEarth(const View& view) {
  for (const auto& section : view.sections) {
    if (!isPlace(section.bytes)) continue;
    std::istringstream in(section.bytes);
    PlaceOnEarth place;
    place.map_from_enu = graph::readId<base::VariableId>(in);
    if (!view.graph.contains(place.map_from_enu)) continue;
    for (double* number : {&place.origin.latitude, &place.origin.longitude, &place.origin.altitude})
      *number = graph::readDouble(in);
    return place;
  }
  return std::nullopt;
}

EarthFrame::EarthFrame(const PlaceOnEarth& place, const View& view)
    : origin_(place.origin), enu_from_map_(-poseOf(view.graph, place.map_from_enu)) {}

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

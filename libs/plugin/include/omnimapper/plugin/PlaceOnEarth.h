#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/plugin/View.h>

#include <Eigen/Core>
#include <optional>
#include <string>

// Where a map is on the earth. A plugin that knows this place passes it to outputs in the plugin's section of the map
// file; a mark at the end identifies such a section.
namespace omnimapper::mapper {

/// [deg] WGS84, altitude [m] above the ellipsoid.
struct Geodetic {
  double latitude = 0, longitude = 0, altitude = 0;
};

struct PlaceOnEarth {
  base::VariableId map_from_enu;  ///< a pose: where the east-north-up frame of the origin is in the map
  Geodetic origin;
};

/// The bytes of a plugin's section that holds `place`.
std::string writePlace(const PlaceOnEarth& place);

/// The place on earth that the sections of a map hold: the first whose variable is still in the graph; none if there is
/// none.
std::optional<PlaceOnEarth> placeOnEarth(const View& view);

/// Converts points of the map to longitude, latitude and altitude.
class EarthFrame {
 public:
  EarthFrame(const PlaceOnEarth& place, const View& view);
  Geodetic operator()(const Eigen::Vector3d& point_in_map) const;

 private:
  Geodetic origin_;
  mrpt::poses::CPose3D enu_from_map_;
};

}  // namespace omnimapper::mapper

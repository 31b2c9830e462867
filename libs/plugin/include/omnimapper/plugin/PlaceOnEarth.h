#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/plugin/View.h>

#include <Eigen/Core>
#include <optional>
#include <string>

// Where a map is on the earth, as a plugin that knows tells it to outputs: by its section of the map file, which ends
// with a mark that says so.
namespace omnimapper::mapper {

/// [deg] WGS84, altitude [m] above the ellipsoid.
struct Geodetic {
  double latitude = 0, longitude = 0, altitude = 0;
};

struct PlaceOnEarth {
  base::VariableId map_from_enu;  ///< a pose: where the east-north-up frame of the origin is in the map
  Geodetic origin;
};

/// The bytes of such a section.
std::string writePlace(const PlaceOnEarth& place);

/// What the sections of a map tell; the first one if there are several. None if nobody knows, or its variable is gone.
std::optional<PlaceOnEarth> placeOnEarth(const View& view);

/// Turns points of the map into longitude and latitude.
class EarthFrame {
 public:
  EarthFrame(const PlaceOnEarth& place, const View& view);
  Geodetic operator()(const Eigen::Vector3d& point_in_map) const;

 private:
  Geodetic origin_;
  mrpt::poses::CPose3D enu_from_map_;
};

}  // namespace omnimapper::mapper

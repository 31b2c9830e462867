#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/plugin/State.h>

#include <Eigen/Core>
#include <string>

// Where a map is on the earth.
namespace omnimapper::mapper {

/// [deg] WGS84, altitude [m] above the ellipsoid.
struct Geodetic {
  double latitude = 0, longitude = 0, altitude = 0;
};

/// The layer "place on earth" of a map, which a plugin sets that knows where the map is.
struct PlaceOnEarth {
  static constexpr char kLayer[] = "place on earth";
  static constexpr std::uint32_t kLayerVersion = 1;

  base::VariableId map_from_enu;  ///< a pose: where the east-north-up frame of the origin is in the map
  Geodetic origin;

  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is of a later version or damaged.
  static PlaceOnEarth fromSection(const map::MapSection& section);
  map::LayerReferences references() const { return {{}, {}, {map_from_enu}}; }
};

/// The place on earth of a map; null if it is not known, or if its variable is no longer in the graph or no pose.
const PlaceOnEarth* placeOnEarth(const State& state);

/// Earlier programs wrote the place into the state of the plugin that knew it. If `layers` have no place on earth, this
/// function sets it from such a state whose variable is in `graph`.
void adoptPlaceOnEarth(map::Layers& layers, const graph::Graph& graph);

/// Converts points of the map to longitude, latitude and altitude.
class EarthFrame {
 public:
  EarthFrame(const PlaceOnEarth& place, const State& state);
  Geodetic operator()(const Eigen::Vector3d& point_in_map) const;

 private:
  Geodetic origin_;
  mrpt::poses::CPose3D enu_from_map_;
};

}  // namespace omnimapper::mapper

#pragma once

#include <omnimapper/map/PayloadRegistry.h>

#include <cstdint>

namespace beacons {

// Step 3: what is known of a landmark beside its variables. It is stored in the map file with the landmark, and read
// again when the map is continued. It is immutable: a plugin that learns more gives the map a new one.

/// The number of a beacon, and the range of distances from which it was seen.
struct BeaconPayload : omnimapper::map::LandmarkPayload {
  BeaconPayload(std::int32_t number, double nearest, double farthest)
      : number(number), nearest(nearest), farthest(farthest) {}

  std::string_view kind() const override { return "beacon"; }
  void write(std::ostream& out) const override;
  /// Registers the reader of what write() wrote.
  static void addTo(omnimapper::map::PayloadRegistry& registry);

  const std::int32_t number;       ///< the sensor's landmarkID
  const double nearest, farthest;  ///< [m] smallest and largest measured range
};

}  // namespace beacons

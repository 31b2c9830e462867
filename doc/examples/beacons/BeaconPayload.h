#pragma once

#include <omnimapper/map/PayloadRegistry.h>

#include <cstdint>

namespace beacons {

// Step 3: what is known of a landmark beside what is optimised. It goes into the map file with the landmark, and comes
// back when the map is continued. Immutable: who learns more hands the map a new one.

/// Which beacon it is, and from how near and how far it was seen.
struct BeaconPayload : omnimapper::map::LandmarkPayload {
  BeaconPayload(std::int32_t number, double nearest, double farthest)
      : number(number), nearest(nearest), farthest(farthest) {}

  std::string_view kind() const override { return "beacon"; }
  void write(std::ostream& out) const override;
  /// Teaches a registry to read what write() wrote.
  static void addTo(omnimapper::map::PayloadRegistry& registry);

  const std::int32_t number;       ///< the sensor's landmarkID
  const double nearest, farthest;  ///< [m] of its measurements
};

}  // namespace beacons

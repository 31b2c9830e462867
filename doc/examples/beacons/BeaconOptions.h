#pragma once

#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/SensorCorrections.h>

#include <string>

namespace beacons {

// Step 4: what a user can set. Each key is declared once, in table(): reading, checking, --print-ini and the messages
// about misspelt keys all come from there. A key ends in its unit; "_deg" is radians in memory.

struct BeaconOptions : omnimapper::mapper::AssociationOptions, omnimapper::mapper::SensorPoseTrust {
  std::string label;                                                            ///< empty: every sensor of that kind
  double height = 1;                                                            ///< [m] above the floor of the map
  double sigma_range = 0.05;                                                    ///< [m]
  double sigma_yaw = 0.5 * omnimapper::base::option_text::kRadiansPerDegree;    ///< [rad]
  double sigma_pitch = 0.5 * omnimapper::base::option_text::kRadiansPerDegree;  ///< [rad]

  static const omnimapper::base::OptionTable<BeaconOptions>& table();
};

}  // namespace beacons

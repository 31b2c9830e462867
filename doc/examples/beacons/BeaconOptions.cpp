#include "BeaconOptions.h"

namespace beacons {

using omnimapper::base::OptionTable;
using omnimapper::base::Range;

const OptionTable<BeaconOptions>& BeaconOptions::table() {
  using Options = BeaconOptions;
  static const auto table = [] {
    auto own =
        OptionTable<Options>()
            .text("label", &Options::label, "Sensor label; empty for every sensor of ranges and bearings.")
            .number("height_m", &Options::height, {}, "Height of all beacons in the map.")
            .number("sigma_range_m", &Options::sigma_range, Range::positive(), "Standard deviation of a range.")
            .number("sigma_yaw_deg", &Options::sigma_yaw, Range::positive(), "Standard deviation of a yaw.")
            .number("sigma_pitch_deg", &Options::sigma_pitch, Range::positive(), "Standard deviation of a pitch.");
    omnimapper::mapper::AssociationOptions::declareIn(own);
    return omnimapper::mapper::SensorPoseTrust::declareIn(own);
  }();
  return table;
}

}  // namespace beacons

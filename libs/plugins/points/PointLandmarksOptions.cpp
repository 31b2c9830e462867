#include "PointLandmarksOptions.h"

namespace omnimapper::plugins {

const base::OptionTable<PointLandmarksOptions>& PointLandmarksOptions::table() {
  using Options = PointLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .text("label", &Options::label, "Sensor label of the range-bearing sensor; empty for every such sensor.")
            .number("sigma_range_m", &Options::sigma_range, Range::notNegative(),
                    "Standard deviation of a measured range; 0 uses the value that the observation reports.")
            .number("sigma_yaw_deg", &Options::sigma_yaw, Range::notNegative(),
                    "Standard deviation of a measured yaw; 0 uses the value that the observation reports.")
            .number("sigma_pitch_deg", &Options::sigma_pitch, Range::notNegative(),
                    "Standard deviation of a measured pitch; 0 uses the value that the observation reports.")
            .number("loss_scale", &Options::loss_scale, Range::positive(),
                    "Number of standard deviations beyond which a measurement that disagrees loses influence (scale of "
                    "the Huber loss).");
    return declareIn(own);
  }();
  return table;
}

}  // namespace omnimapper::plugins

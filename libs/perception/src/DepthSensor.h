#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/Normals.h>

namespace omnimapper::perception {

/// What the options of every extractor of depth images say of the sensor.
template <class Options>
base::OptionTable<Options> depthSensorTable() {
  using base::Range;
  return base::OptionTable<Options>()
      .number("noise_at_1m_m", &Options::noise_at_1m, Range::positive(),
              "Standard deviation of a pixel's depth at 1 m; it grows with the square of the depth.")
      .number("step_at_1m_m", &Options::step_at_1m, Range::notNegative(),
              "Step between two depths that the sensor can tell apart at 1 m; 0 if it has none.")
      .number("correlation_area_px2", &Options::correlation_area, {1, 10000},
              "How many neighbouring pixels share one error.")
      .number("min_depth_m", &Options::min_depth, Range::positive(), "Nearer pixels are left out.")
      .number("max_depth_m", &Options::max_depth, Range::positive(), "Farther pixels are left out.");
}

/// What the options of those that tell covariances add.
inline constexpr char kScaleHelp[] =
    "Relative error of depth that all pixels share, standard deviation; covariances count it.";

/// Throws Error(out_of_range) unless 0 < min_depth < max_depth.
template <class Options>
void refuseDepths(const char* who, const Options& options) {
  using base::option_text::format;
  if (options.min_depth > 0 && options.min_depth < options.max_depth) return;
  throw base::Error(base::ExitCode::out_of_range,
                    std::string(who) + ": min_depth_m = " + format(options.min_depth) +
                        " must be > 0 and below max_depth_m = " + format(options.max_depth) +
                        "; make the span from one to the other the sensor's");
}

/// Normals by that sensor.
template <class Options>
NormalOptions normalsBy(const Options& sensor, int radius = NormalOptions().radius) {
  NormalOptions options;
  options.noise_at_1m = sensor.noise_at_1m;
  options.step_at_1m = sensor.step_at_1m;
  options.min_depth = sensor.min_depth;
  options.max_depth = sensor.max_depth;
  options.radius = radius;
  return options;
}

}  // namespace omnimapper::perception

#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/Normals.h>

namespace omnimapper::perception {

/// Options of the sensor that all extractors of depth images have.
template <class Options>
base::OptionTable<Options> depthSensorTable() {
  using base::Range;
  return base::OptionTable<Options>()
      .number("noise_at_1m_m", &Options::noise_at_1m, Range::positive(),
              "Standard deviation of a pixel's depth at 1 m. It grows with the square of the depth.")
      .number("step_at_1m_m", &Options::step_at_1m, Range::notNegative(),
              "Difference between successive depths that the sensor can report, at 1 m. 0 means that depths are not "
              "rounded to such steps.")
      .number("correlation_area_px2", &Options::correlation_area, {1, 10000},
              "Number of neighbouring pixels that share one depth error.")
      .number("min_depth_m", &Options::min_depth, Range::positive(), "Pixels with a smaller depth are left out.")
      .number("max_depth_m", &Options::max_depth, Range::positive(), "Pixels with a larger depth are left out.");
}

/// Help text of the option scale_sigma, which extractors that report covariances add.
inline constexpr char kScaleHelp[] =
    "Standard deviation of the relative depth error that all pixels share. Reported covariances include it.";

/// Throws Error(out_of_range) unless 0 < min_depth < max_depth.
template <class Options>
void refuseDepths(const char* who, const Options& options) {
  using base::option_text::format;
  if (options.min_depth > 0 && options.min_depth < options.max_depth) return;
  throw base::Error(base::ExitCode::out_of_range,
                    std::string(who) + ": min_depth_m = " + format(options.min_depth) +
                        " must be > 0 and below max_depth_m = " + format(options.max_depth) +
                        "; set both to the limits of the sensor's range");
}

/// Options to estimate normals from images of that sensor.
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

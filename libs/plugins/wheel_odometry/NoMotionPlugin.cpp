#include "NoMotionPlugin.h"

#include <algorithm>

namespace omnimapper::plugins {

const base::OptionTable<NoMotionOptions>& NoMotionOptions::table() {
  using Options = NoMotionOptions;
  static const auto table = base::OptionTable<Options>()
                                .number("position_sigma_m", &Options::position_sigma, base::Range::positive(),
                                        "Standard deviation of each coordinate after 1 s of assumed rest; it grows "
                                        "with the root of time.")
                                .number("angle_sigma_deg", &Options::angle_sigma, base::Range::positive(),
                                        "Standard deviation of each angle after 1 s of assumed rest; it grows with "
                                        "the root of time.");
  return table;
}

std::optional<mapper::RelativeMotion> NoMotionPlugin::between(base::Stamp begin, base::Stamp end) const {
  if (end < begin) return std::nullopt;
  // A span of no length gets a variance, too, because a factor needs one.
  const double seconds = std::max(1e-3, base::secondsBetween(begin, end));
  mapper::RelativeMotion motion{mrpt::poses::CPose3D(), Eigen::Matrix<double, 6, 6>::Zero()};
  motion.covariance.diagonal().head<3>().setConstant(options_.position_sigma * options_.position_sigma * seconds);
  motion.covariance.diagonal().tail<3>().setConstant(options_.angle_sigma * options_.angle_sigma * seconds);
  return motion;
}

}  // namespace omnimapper::plugins

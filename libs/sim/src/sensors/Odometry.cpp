#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Odometry.h>

#include <cmath>

#include "TruthText.h"

namespace omnimapper::sim {

namespace {
constexpr std::uint64_t kBiasStream = 1, kSlipStream = 2;
}

const base::OptionTable<OdometryOptions>& OdometryOptions::table() {
  using base::Range;
  using Options = OdometryOptions;
  const Range positive = Range::positive(), zero_or_more = Range::notNegative();
  static const auto table =
      base::OptionTable<Options>()
          .number("wheel_base_m", &Options::wheel_base, positive, "Distance between the two wheels.")
          .number("radius_bias", &Options::radius_bias, {0, 0.5},
                  "Standard deviation of the relative error of each wheel's radius, which is drawn once.")
          .number("base_bias", &Options::base_bias, {0, 0.2},
                  "Standard deviation of the relative error of the wheel base, which is drawn once.")
          .number("slip_per_root_m", &Options::slip_per_root_m, zero_or_more,
                  "Standard deviation of the distance error after 1 m of travel [m]. It grows with the square root of "
                  "the distance.")
          .number("turn_slip_per_root_m_deg", &Options::turn_slip_per_root_m, zero_or_more,
                  "Standard deviation of the heading error after 1 m of travel. It grows with the square root of the "
                  "distance.")
          .number("turn_slip_per_root_turn", &Options::turn_slip_per_root_turn, zero_or_more,
                  "Standard deviation of the heading error after 1 rad of turning [rad]. It grows with the square root "
                  "of the angle.")
          .number("ticks_per_m", &Options::ticks_per_metre, zero_or_more,
                  "Resolution of each wheel's encoder in ticks per metre, to which it rounds. 0 means no encoders.")
          .flag("velocities", &Options::velocities,
                "Each reading reports the mean velocity since the previous reading.");
  return table;
}

Odometry::Odometry(const OdometryOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context), options_(options) {
  Random bias = randomOf(0, kBiasStream);
  bias_.left = 1 + bias.gaussian(options.radius_bias);
  bias_.right = 1 + bias.gaussian(options.radius_bias);
  bias_.base = 1 + bias.gaussian(options.base_bias);
  const double base = options.wheel_base;
  const auto ticked = [&](double travel) {
    return options.ticks_per_metre > 0 ? std::round(travel * options.ticks_per_metre) / options.ticks_per_metre
                                       : travel;
  };
  Reading reading;
  for (int k = 0; k < count(); ++k) {
    const geometry::Se2 truth = trueIncrement(k);
    const double travel = truth.translation().norm(), turn = std::abs(truth.yaw);
    Random slip = randomOf(k, kSlipStream);
    const double along = truth.x + slip.gaussian(options.slip_per_root_m * std::sqrt(travel));
    const double turned = truth.yaw + slip.gaussian(std::hypot(options.turn_slip_per_root_m * std::sqrt(travel),
                                                               options.turn_slip_per_root_turn * std::sqrt(turn)));
    // The distances that the wheels measure, and the motion that follows from them with the assumed radius and base.
    const double left = bias_.left * (along - 0.5 * base * turned), right = bias_.right * (along + 0.5 * base * turned);
    const double measured_left = ticked(reading.left + left) - ticked(reading.left);
    const double measured_right = ticked(reading.right + right) - ticked(reading.right);
    reading.left += left, reading.right += right;
    const geometry::Se2 measured{0.5 * (measured_left + measured_right), truth.y,
                                 bias_.base * (measured_right - measured_left) / base};
    reading.odom_from_base = reading.odom_from_base * measured;
    readings_.push_back(reading);
  }
}

geometry::Se2 Odometry::trueIncrement(int k) const {
  if (k == 0) return {};
  const Track& track = *context().map_from_base;
  return geometry::project(geometry::inverse(*track.at(timeOf(k - 1))) * *track.at(timeOf(k)));
}

Measurement Odometry::measure(int k) const {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  stamp(*odometry, k);
  const Reading& reading = readings_[k];
  odometry->odometry = mrpt::poses::CPose2D(geometry::toMrpt(reading.odom_from_base));
  odometry->hasVelocities = options_.velocities;
  if (options_.velocities && k > 0) {
    const geometry::Se2 moved = geometry::inverse(readings_[k - 1].odom_from_base) * reading.odom_from_base;
    const double rate = options().rate;
    odometry->velocityLocal = {rate * moved.x, rate * moved.y, rate * moved.yaw};
  }
  odometry->hasEncodersInfo = options_.ticks_per_metre > 0;
  odometry->encoderLeftTicks = static_cast<int>(std::lround(reading.left * options_.ticks_per_metre));
  odometry->encoderRightTicks = static_cast<int>(std::lround(reading.right * options_.ticks_per_metre));
  const geometry::Se2 truth = trueIncrement(k);
  const nlohmann::ordered_json line{{"increment", {rounded(truth.x), rounded(truth.y), rounded(truth.yaw)}}};
  return {odometry, line.dump(), {}};
}

}  // namespace omnimapper::sim

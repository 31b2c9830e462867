#pragma once

#include <omnimapper/sim/Sensor.h>

#include <vector>

namespace omnimapper::sim {

/// Errors of wheel odometry, as large as those of ACES (doc/results/simulator.md). Biases are drawn once for the run,
/// slip anew all the time; variances add up.
struct OdometryOptions {
  double wheel_base = 0.5;                 ///< between the wheels [m]
  double radius_bias = 0.0012;             ///< standard deviation of the relative error of each wheel's radius
  double base_bias = 0.015;                ///< of the relative error of the wheel base
  double slip_per_root_m = 0.02;           ///< of the way after 1 m of way [m]; grows with its root
  double turn_slip_per_root_m = 0.009;     ///< of the heading after 1 m of way [rad]
  double turn_slip_per_root_turn = 0.012;  ///< of the heading after 1 rad of turning [rad]
  double ticks_per_metre = 0;              ///< of each wheel's encoder; 0: no encoders, nothing is rounded
  bool velocities = true;
  static const base::OptionTable<OdometryOptions>& table();
};

/// Wheel odometry: CObservationOdometry, the cumulative pose since the start, which is 0, with the mean velocity since
/// the measurement before. On slopes the way along the ground counts.
/// Truth, one line each: "increment" [x, y, yaw], the true motion of the base since the measurement before, in the base
/// of then [m, rad].
class Odometry : public Sensor {
 public:
  Odometry(const OdometryOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

  /// What bias does in this run: way and heading reported for 1 m straight on, heading for 1 rad in place.
  struct Bias {
    double left = 1, right = 1, base = 1;  ///< true over assumed radius of each wheel; assumed over true wheel base
  };
  const Bias& bias() const { return bias_; }

 private:
  geometry::Se2 trueIncrement(int k) const;

  OdometryOptions options_;
  Bias bias_;
  struct Reading {
    geometry::Se2 odom_from_base;
    double left = 0, right = 0;  // way of each wheel [m]
  };
  std::vector<Reading> readings_;
};

}  // namespace omnimapper::sim

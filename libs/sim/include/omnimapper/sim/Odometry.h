#pragma once

#include <omnimapper/sim/Sensor.h>

#include <vector>

namespace omnimapper::sim {

/// Errors of wheel odometry; the defaults are as large as those of the log ACES (doc/results/simulator.md). Biases are
/// drawn once for a run. Slip is drawn for each measurement; its sigmas grow with the root of the travel or turn, and
/// the variances of its parts add up.
struct OdometryOptions {
  double wheel_base = 0.5;                 ///< between the wheels [m]
  double radius_bias = 0.0012;             ///< standard deviation of the relative error of each wheel's radius
  double base_bias = 0.015;                ///< standard deviation of the relative error of the wheel base
  double slip_per_root_m = 0.02;           ///< sigma of the distance after 1 m of travel [m]
  double turn_slip_per_root_m = 0.009;     ///< sigma of the heading after 1 m of travel [rad]
  double turn_slip_per_root_turn = 0.012;  ///< sigma of the heading after 1 rad of turning [rad]
  double ticks_per_metre = 0;              ///< resolution of each wheel's encoder; 0: no encoders, nothing is rounded
  bool velocities = true;
  static const base::OptionTable<OdometryOptions>& table();
};

/// Wheel odometry: CObservationOdometry with the pose accumulated since the start, where the pose is 0, and with the
/// mean velocity since the previous measurement. On slopes the distance along the ground counts. The truth has one line
/// for each measurement: "increment" [x, y, yaw] is the true motion of the base since the previous measurement, in the
/// base frame at that time [m, rad].
class Odometry : public Sensor {
 public:
  Odometry(const OdometryOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

  /// Biases of this run: the ratio of the reported to the true distance of each wheel, and the ratio of the reported to
  /// the true turn, which an error of the wheel base causes.
  struct Bias {
    double left = 1, right = 1, base = 1;
  };
  const Bias& bias() const { return bias_; }

 private:
  geometry::Se2 trueIncrement(int k) const;

  OdometryOptions options_;
  Bias bias_;
  struct Reading {
    geometry::Se2 odom_from_base;
    double left = 0, right = 0;  // reported distance travelled by each wheel, before rounding [m]
  };
  std::vector<Reading> readings_;
};

}  // namespace omnimapper::sim

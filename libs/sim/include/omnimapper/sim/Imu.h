#pragma once

#include <omnimapper/sim/Sensor.h>

#include <vector>

namespace omnimapper::sim {

/// Noise and bias of an IMU; the defaults are those of a small MEMS unit.
struct ImuOptions {
  double gyro_noise = 1e-4;           ///< density of white noise [rad/s/sqrt(Hz)]
  double accelerometer_noise = 1e-3;  ///< [m/s^2/sqrt(Hz)]
  double gyro_bias = 2e-3;            ///< standard deviation of the bias at the start [rad/s]
  double accelerometer_bias = 0.03;   ///< [m/s^2]
  double gyro_walk = 2e-5;  ///< standard deviation of the bias change after 1 s [rad/s]; grows with the root of time
  double accelerometer_walk = 3e-4;  ///< [m/s^2]
  double gravity = 9.80665;          ///< [m/s^2]
  static const base::OptionTable<ImuOptions>& table();
};

/// A gyroscope and accelerometer: CObservationIMU with WX, WY, WZ and X_ACC, Y_ACC, Z_ACC in the sensor's frame. The
/// accelerometer measures specific force: if the sensor stands still and level, its z is +gravity. Rates are means over
/// a span of time around the stamp, which lasts 1 / rate_hz, or two steps of the robot's track if they last longer.
/// Accelerations follow from the positions one span before, at and one span after the stamp. Near both ends of the
/// track, the nearest time for which the track has these positions is taken; after its end the sensor stands still. The
/// truth has one line for each measurement, with "gyro" and "acceleration" (without bias and noise), "gyro_bias" and
/// "acceleration_bias".
class Imu : public Sensor {
 public:
  Imu(const ImuOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  struct Rates {
    Eigen::Vector3d gyro, acceleration;  // in the sensor's frame [rad/s], [m/s^2]
  };
  Rates ratesAt(double time) const;

  ImuOptions options_;
  double span_;                // time over which means are taken [s]
  std::vector<Rates> biases_;  // at each measurement
};

}  // namespace omnimapper::sim

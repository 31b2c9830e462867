#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim/Imu.h>

#include <algorithm>
#include <cmath>

#include "TruthText.h"

namespace omnimapper::sim {

namespace {

constexpr std::uint64_t kWalkStream = 1, kNoiseStream = 2;

Eigen::Vector3d gaussian3(Random& random, double sigma) {
  const double x = random.gaussian(sigma), y = random.gaussian(sigma), z = random.gaussian(sigma);
  return {x, y, z};
}

nlohmann::ordered_json asJson(const Eigen::Vector3d& vector) {
  return {rounded(vector.x()), rounded(vector.y()), rounded(vector.z())};
}

}  // namespace

const base::OptionTable<ImuOptions>& ImuOptions::table() {
  using Options = ImuOptions;
  const auto zero_or_more = base::Range::notNegative();
  static const auto table =
      base::OptionTable<Options>()
          .number("gyro_noise", &Options::gyro_noise, zero_or_more,
                  "Density of the gyroscope's white noise [rad/s/sqrt(Hz)].")
          .number("accelerometer_noise", &Options::accelerometer_noise, zero_or_more,
                  "Density of the accelerometer's white noise [m/s^2/sqrt(Hz)].")
          .number("gyro_bias_rad_s", &Options::gyro_bias, zero_or_more,
                  "Standard deviation of the gyroscope's bias at the start.")
          .number("accelerometer_bias_m_s2", &Options::accelerometer_bias, zero_or_more,
                  "Standard deviation of the accelerometer's bias at the start.")
          .number("gyro_walk_rad_s", &Options::gyro_walk, zero_or_more,
                  "Standard deviation of the change of the gyroscope's bias after 1 s. It grows with the square root "
                  "of time.")
          .number("accelerometer_walk_m_s2", &Options::accelerometer_walk, zero_or_more,
                  "Standard deviation of the change of the accelerometer's bias after 1 s. It grows with the square "
                  "root of time.")
          .number("gravity_m_s2", &Options::gravity, zero_or_more,
                  "Gravitational acceleration at the simulated place.");
  return table;
}

Imu::Imu(const ImuOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context), options_(options), span_(std::max(1 / mount.rate, 2.0 / kDriveRate)) {
  Random start = randomOf(0, kWalkStream);
  Rates bias{gaussian3(start, options.gyro_bias), gaussian3(start, options.accelerometer_bias)};
  const double root = std::sqrt(1 / mount.rate);
  for (int k = 0; k < count(); ++k) {
    biases_.push_back(bias);
    Random step = randomOf(k + 1, kWalkStream);
    bias.gyro += gaussian3(step, options.gyro_walk * root);
    bias.acceleration += gaussian3(step, options.accelerometer_walk * root);
  }
}

Imu::Rates Imu::ratesAt(double time) const {
  const Eigen::Matrix3d map_from_sensor = mapFromSensor(time).rotation.toRotationMatrix();
  const Eigen::Vector3d up(0, 0, options_.gravity);
  const auto& places = context().map_from_base->places();
  const double begin = places.front().time, end = places.back().time;
  if (end - begin < 2 * span_ || time > end) return {Eigen::Vector3d::Zero(), map_from_sensor.transpose() * up};
  // The track does not describe the motion before its begin and after its end.
  const double middle = std::clamp(time, begin + span_, end - span_);
  const geometry::Se3 before = mapFromSensor(middle - 0.5 * span_), after = mapFromSensor(middle + 0.5 * span_);
  const Eigen::Vector3d early = mapFromSensor(middle - span_).translation, now = mapFromSensor(middle).translation,
                        late = mapFromSensor(middle + span_).translation;
  const Eigen::Vector3d acceleration_in_map = (late - 2 * now + early) / (span_ * span_);
  return {geometry::minus(after, before).tail<3>() / span_, map_from_sensor.transpose() * (acceleration_in_map + up)};
}

Measurement Imu::measure(int k) const {
  using namespace mrpt::obs;
  const Rates truth = ratesAt(timeOf(k));
  const Rates& bias = biases_[k];
  Random random = randomOf(k, kNoiseStream);
  const double root = std::sqrt(options().rate);
  const Eigen::Vector3d gyro = truth.gyro + bias.gyro + gaussian3(random, options_.gyro_noise * root);
  const Eigen::Vector3d acceleration =
      truth.acceleration + bias.acceleration + gaussian3(random, options_.accelerometer_noise * root);
  auto imu = CObservationIMU::Create();
  stamp(*imu, k);
  imu->sensorPose = geometry::toMrpt(baseFromSensor());
  imu->set(IMU_WX, gyro.x());
  imu->set(IMU_WY, gyro.y());
  imu->set(IMU_WZ, gyro.z());
  imu->set(IMU_X_ACC, acceleration.x());
  imu->set(IMU_Y_ACC, acceleration.y());
  imu->set(IMU_Z_ACC, acceleration.z());
  const nlohmann::ordered_json line{{"gyro", asJson(truth.gyro)},
                                    {"acceleration", asJson(truth.acceleration)},
                                    {"gyro_bias", asJson(bias.gyro)},
                                    {"acceleration_bias", asJson(bias.acceleration)}};
  return {imu, line.dump(), {}};
}

}  // namespace omnimapper::sim

#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/testing/SimulatedBeacons.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

namespace omnimapper::testing {

using mrpt::poses::CPose3D;

std::vector<Eigen::Vector3d> SimulatedBeacons::inRing() {
  return {{-6, -3.8, 1.4}, {-2, -1.4, 1.4},   {1.9, 1.4, 1.4}, {5.5, -4.3, 1.4}, {9.9, -1.4, 1.4},
          {11, 2, 1.4},    {7.1, 4.5, 1.4},   {12.2, 7, 1.4},  {4.5, 11.8, 1.4}, {-1, 12.8, 1.4},
          {-5, 7.6, 1.4},  {-9.9, 10.4, 1.4}, {-7.1, 6, 1.4},  {-11.8, 2, 1.4}};
}

CPose3D SimulatedBeacons::baseFromReported(double seconds) const {
  constexpr double kTurn = 2 * 3.14159265358979323846;
  const double pan = pan_reach * std::sin(kTurn * seconds / pan_period);
  const double tilt = tilt_reach * std::sin(kTurn * seconds / tilt_period);
  return base_from_head + CPose3D(0, 0, 0, pan, tilt, 0);
}

mrpt::obs::CObservation::Ptr SimulatedBeacons::measurements(const FloorPlan& plan, const CPose3D& map_from_base,
                                                            base::Stamp stamp, double seconds, Dice& dice) const {
  auto observation = mrpt::obs::CObservationBearingRange::Create();
  observation->sensorLabel = "beacons";
  observation->timestamp = stamp;
  observation->sensorLocationOnRobot = baseFromReported(seconds);
  observation->maxSensorDistance = static_cast<float>(max_range);
  observation->sensor_std_range = static_cast<float>(sigma_range);
  observation->sensor_std_yaw = static_cast<float>(sigma_yaw);
  observation->sensor_std_pitch = static_cast<float>(sigma_pitch);
  const CPose3D map_from_sensor = map_from_base + observation->sensorLocationOnRobot + reported_from_sensor;
  const Eigen::Vector2d eye(map_from_sensor.x(), map_from_sensor.y());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double noise[] = {dice.normal(sigma_range), dice.normal(sigma_yaw), dice.normal(sigma_pitch)};
    const Eigen::Vector2d to_beacon = positions[i].head<2>() - eye;
    double range, yaw, pitch;
    map_from_sensor.sphericalCoordinates({positions[i].x(), positions[i].y(), positions[i].z()}, range, yaw, pitch);
    if (range > max_range || plan.distanceToWall(eye, to_beacon.normalized()) < to_beacon.norm()) continue;
    mrpt::obs::CObservationBearingRange::TMeasurement measurement;
    measurement.landmarkID = static_cast<std::int32_t>(i);
    measurement.range = static_cast<float>(range + noise[0]);
    measurement.yaw = static_cast<float>(yaw + noise[1]);
    measurement.pitch = static_cast<float>(pitch + noise[2]);
    observation->sensedData.push_back(measurement);
  }
  return observation;
}

}  // namespace omnimapper::testing

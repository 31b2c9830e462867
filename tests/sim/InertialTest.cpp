#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/topography/conversions.h>
#include <omnimapper/sim/Drive.h>

#include <nlohmann/json.hpp>

#include "SensorRun.h"
#include "SmallWorlds.h"

namespace inertial_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationIMU;

const std::string exact_imu =
    "class = Imu\nrate_hz = 100\ngyro_noise = 0\naccelerometer_noise = 0\ngyro_bias_rad_s = 0\n"
    "accelerometer_bias_m_s2 = 0\ngyro_walk_rad_s = 0\naccelerometer_walk_m_s2 = 0\n";

Eigen::Vector3d gyroOf(const CObservationIMU& imu) {
  return {imu.get(mrpt::obs::IMU_WX), imu.get(mrpt::obs::IMU_WY), imu.get(mrpt::obs::IMU_WZ)};
}
Eigen::Vector3d forceOf(const CObservationIMU& imu) {
  return {imu.get(mrpt::obs::IMU_X_ACC), imu.get(mrpt::obs::IMU_Y_ACC), imu.get(mrpt::obs::IMU_Z_ACC)};
}

TEST(Imu, standingStillItFeelsTheFloorPushUp) {
  const SensorRun level(oneRoom(6, 4), sim::Track(at(2, 2, 0, 1)), exact_imu);
  EXPECT_LT((forceOf(*level.measure<CObservationIMU>(0)) - Eigen::Vector3d(0, 0, 9.80665)).norm(), 1e-9);
  EXPECT_LT(gyroOf(*level.measure<CObservationIMU>(0)).norm(), 1e-12);
  // With the nose down by 90 degrees, up is behind the sensor.
  const SensorRun tilted(oneRoom(6, 4), sim::Track(at(2, 2)), exact_imu + "pitch_deg = 90");
  EXPECT_LT((forceOf(*tilted.measure<CObservationIMU>(0)) - Eigen::Vector3d(-9.80665, 0, 0)).norm(), 1e-9);
}

TEST(Imu, onACircleItFeelsTheTurnAndTheMiddle) {
  std::vector<sim::Track::Place> places;
  for (int i = 0; i <= 1000; ++i) {
    const double angle = 0.005 * i;  // 0.5 rad/s on a radius of 2 m
    places.push_back({0.01 * i, at(2 * std::cos(angle), 2 * std::sin(angle), 0, angle + M_PI / 2)});
  }
  const SensorRun run(oneRoom(6, 4), sim::Track(sim::Track::Kind::motion, places), exact_imu, 9);
  const auto imu = run.measure<CObservationIMU>(400);
  EXPECT_NEAR(gyroOf(*imu).z(), 0.5, 1e-9);
  EXPECT_NEAR(forceOf(*imu).y(), 2 * 0.25, 1e-4);
  EXPECT_NEAR(forceOf(*imu).x(), 0, 1e-6);
}

TEST(Imu, withoutNoiseItIntegratesBackToTheTrajectory) {
  for (const std::string keys : {"", "handheld = true\n"}) {
    const sim::Track track =
        sim::planDrive(base::Config::fromText("[robot]\n" + keys + "duration_s = 30\n", "test.ini"), threeRooms());
    const SensorRun run(threeRooms(), track, exact_imu, 30);
    const double step = 0.01;
    const int first = 5;
    const auto place = [&](int k) { return track.at(k * step)->translation; };
    geometry::Se3 pose = *track.at((first - 1) * step);
    // Means are over two steps; the velocity at their beginning is a mean as well.
    Eigen::Vector3d velocity = (place(first + 1) + place(first) - place(first - 1) - place(first - 2)) / (4 * step);
    double worst_turn = 0, worst_place = 0;
    for (int k = first; k + 3 < run.sensor().count(); ++k) {
      const auto imu = run.measure<CObservationIMU>(k);
      const Eigen::Quaterniond rotation = track.at(k * step)->rotation;
      pose.translation += velocity * step;
      velocity += (rotation * forceOf(*imu) - Eigen::Vector3d(0, 0, 9.80665)) * step;
      pose.rotation = (pose.rotation * geometry::expSo3(Eigen::Vector3d(gyroOf(*imu) * step))).normalized();
      const geometry::Se3 truth = *track.at(k * step);
      worst_turn = std::max(worst_turn, pose.rotation.angularDistance(truth.rotation));
      worst_place = std::max(worst_place, (pose.translation - truth.translation).norm());
    }
    EXPECT_LT(worst_turn, 0.01) << keys;
    EXPECT_LT(worst_place, 0.05) << keys;
  }
}

// There is no jerk where a drive is cut off in motion, nor where the person who carries the sensor sways from the
// start.
TEST(Imu, atBothEndsItMeasuresNoMoreThanDuringTheDrive) {
  const sim::World world = oneRoom(20, 4);
  const sim::Track cut =
      sim::planDrive(base::Config::fromText("[robot]\nmode = waypoints\nstart = 2 2\nwaypoints = 18 2\n"
                                            "max_speed_m_s = 1\nduration_s = 8\n",
                                            "test.ini"),
                     world);
  const sim::Track carried = sim::planDrive(
      base::Config::fromText("[robot]\nmode = still\nstart = 2 2\nhandheld = true\nduration_s = 8\n", "test.ini"),
      world);
  EXPECT_GT((cut.at(8)->translation - cut.at(7.9)->translation).norm(), 0.09);
  for (const sim::Track* track : {&cut, &carried}) {
    const SensorRun run(world, *track, exact_imu, 8);
    const int last = run.sensor().count() - 1;
    ASSERT_EQ(last, 800);
    const auto felt = [&](int k) {
      const Eigen::Vector3d force = track->at(0.01 * k)->rotation * forceOf(*run.measure<CObservationIMU>(k));
      return (force - Eigen::Vector3d(0, 0, 9.80665)).norm();
    };
    double most = 0;
    for (int k = 10; k <= last - 10; ++k) most = std::max(most, felt(k));
    for (const int k : {0, 1, last - 1, last}) EXPECT_LT(felt(k), 1.3 * most) << k;
  }
}

TEST(Imu, noiseAndBiasAreThoseOfItsOptions) {
  const SensorRun run(oneRoom(6, 4), sim::Track(at(2, 2)), exact_imu + "gyro_noise = 0.001\ngyro_walk_rad_s = 0.01",
                      100);
  double white = 0, walk = 0;
  const int count = run.sensor().count();
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (int k = 0; k < count; ++k) {
    const auto bias = nlohmann::json::parse(run.truth(k))["gyro_bias"];
    const Eigen::Vector3d bias_now(bias[0], bias[1], bias[2]);
    white += (gyroOf(*run.measure<CObservationIMU>(k)) - bias_now).squaredNorm() / 3;
    if (k > 0) walk += (bias_now - last).squaredNorm() / 3;
    last = bias_now;
  }
  EXPECT_NEAR(white / count / (1e-6 * 100), 1, 0.05);
  EXPECT_NEAR(walk / (count - 1) / (1e-4 / 100), 1, 0.05);
}

const std::string exact_gps = "class = Gps\nsigma_m = 0\nx_m = 0.3\nz_m = 1\nmap_heading_deg = 30\n";

mrpt::math::TPoint3D enuOf(const CObservationGPS& gps) {
  const auto& gga = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
  mrpt::math::TPoint3D enu;
  mrpt::topography::geodeticToENU_WGS84({gga.latitude_degrees, gga.longitude_degrees, gga.altitude_meters}, enu,
                                        {36.714, -4.4785, 60});
  return enu;
}

TEST(Gps, aFixGoesBackToTheAntenna) {
  const SensorRun run(oneRoom(6, 4), sim::Track(at(100, 20, 0.5, 1)), exact_gps);
  const auto enu = enuOf(*run.measure<CObservationGPS>(0));
  const double x = 100 + 0.3 * std::cos(1), y = 20 + 0.3 * std::sin(1), c = std::cos(M_PI / 6), s = 0.5;
  EXPECT_NEAR(enu.x, c * x - s * y, 1e-5);
  EXPECT_NEAR(enu.y, s * x + c * y, 1e-5);
  EXPECT_NEAR(enu.z, 1.5, 1e-5);
}

TEST(Gps, errorsHaveTheirDeviationAndFade) {
  const SensorRun run(oneRoom(6, 4), sim::Track(at(0, 0)), "class = Gps\nsigma_m = 2\ncorrelation_s = 5\nrate_hz = 1",
                      20000);
  double variance = 0, lagged = 0, up = 0;
  const int count = run.sensor().count(), lag = 5;
  std::vector<Eigen::Vector3d> errors;
  for (int k = 0; k < count; ++k) {
    const auto error = nlohmann::json::parse(run.truth(k))["error_enu"];
    errors.emplace_back(error[0], error[1], error[2]);
  }
  for (int k = lag; k < count; ++k) {
    variance += errors[k].head<2>().squaredNorm() / 2;
    lagged += errors[k].head<2>().dot(errors[k - lag].head<2>()) / 2;
    up += errors[k].z() * errors[k].z();
  }
  EXPECT_NEAR(variance / (count - lag), 4, 0.4);
  EXPECT_NEAR(lagged / variance, std::exp(-1), 0.06);
  EXPECT_NEAR(up / variance, 4, 0.6);
}

TEST(Gps, withoutSkyThereIsNoFix) {
  sim::World world = oneRoom(6, 4);
  addQuad(world, "roof", sim::SurfaceKind::ceiling, {0, 0, 2.5}, {3, 0, 0}, {0, 4, 0});
  const auto quality = [&](double x) {
    const SensorRun run(world, sim::Track(at(x, 2)), exact_gps + "needs_sky = true");
    return run.measure<CObservationGPS>(0)->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields.fix_quality;
  };
  EXPECT_EQ(quality(1), 0);
  EXPECT_EQ(quality(5), 1);
}

}  // namespace
}  // namespace inertial_test

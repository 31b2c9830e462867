#include <gtest/gtest.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Rotation3.h>
#include <omnimapper/motion/Gyroscope.h>

#include <cmath>
#include <limits>

namespace omnimapper::motion::gyroscope_test {
namespace {

using mrpt::obs::CObservationIMU;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1.6e9) + base::durationFromSeconds(seconds);
}

CObservationIMU reading(double seconds, const Eigen::Vector3d& rate, const std::string& label = "imu") {
  CObservationIMU imu;
  imu.timestamp = at(seconds);
  imu.sensorLabel = label;
  imu.set(mrpt::obs::IMU_WX, rate.x());
  imu.set(mrpt::obs::IMU_WY, rate.y());
  imu.set(mrpt::obs::IMU_WZ, rate.z());
  return imu;
}

double degrees(const Eigen::Vector3d& rotation) {
  return rotation.norm() * 180 / geometry::kPi;
}

TEST(Gyroscope, TurnsTheBaseAboutTheAxisOfTheBase) {
  Gyroscope gyroscope{{}};
  for (int i = 0; i <= 100; ++i) {
    auto imu = reading(0.01 * i, {0, 0.5, 0});
    // The sensor is rolled by 90 deg, so that its y is the base's z.
    imu.sensorPose = mrpt::poses::CPose3D(0.3, 0, 1, 0, 0, geometry::kPi / 2);
    EXPECT_TRUE(gyroscope.add(imu));
  }
  const auto turn = gyroscope.between(at(0.2), at(0.8));
  ASSERT_TRUE(turn);
  EXPECT_LT((geometry::logSo3(turn->begin_from_end) - Eigen::Vector3d(0, 0, 0.3)).norm(), 1e-9);
  EXPECT_EQ(gyroscope.coveredUntil(), at(1));
}

TEST(Gyroscope, RatesGoEvenlyFromReadingToReading) {
  Gyroscope gyroscope{{}};
  for (int i = 0; i <= 20; ++i) gyroscope.add(reading(0.05 * i, {0.2 * i, 0, 0}));
  // 4 rad/s after a second of even growth: 2 rad.
  EXPECT_NEAR(geometry::logSo3(gyroscope.between(at(0), at(1))->begin_from_end).x(), 2, 1e-9);
}

TEST(Gyroscope, ItsNoiseAndItsBiasMakeTheCovariance) {
  GyroscopeOptions options;
  options.noise_per_root_s = 0.01;
  options.bias_sigma = 0.02;
  Gyroscope gyroscope{options};
  for (int i = 0; i <= 400; ++i) gyroscope.add(reading(0.01 * i, {0, 0, 0}));
  const auto turn = gyroscope.between(at(0), at(4));
  EXPECT_NEAR(turn->covariance(1, 1), 0.01 * 0.01 * 4 + 0.02 * 0.02 * 16, 1e-9);
}

TEST(Gyroscope, WhatItShowsAtRestIsLearntFromTurnsThatOthersMeasured) {
  Gyroscope gyroscope{{}};
  const Eigen::Vector3d bias(0.01, -0.02, 0.005), rate(0.1, 0, -0.3);
  for (int i = 0; i <= 6000; ++i) gyroscope.add(reading(0.01 * i, rate + bias));
  for (int i = 0; i < 60; ++i) gyroscope.learn(at(i), at(i + 1), geometry::expSo3(rate), 0.005);
  EXPECT_LT((gyroscope.bias() - bias).norm(), 0.001) << gyroscope.bias().transpose();
  const auto turn = gyroscope.between(at(0), at(0.1));
  EXPECT_LT(degrees(geometry::logSo3(turn->begin_from_end) - 0.1 * rate), 0.01);
  EXPECT_LT(std::sqrt(turn->covariance(0, 0)), 0.1 * geometry::kPi / 180);
}

TEST(Gyroscope, ATurnThatCannotBeTrueTeachesNothingAndABiasThatDriftsIsFollowed) {
  Gyroscope gyroscope{{}};
  const auto drifting = [](double seconds) { return Eigen::Vector3d(0, 0, 1e-4 * seconds); };  // 0.34 deg/s per minute
  for (int i = 0; i <= 60000; ++i) gyroscope.add(reading(0.01 * i, drifting(0.01 * i)));
  for (int i = 0; i < 599; ++i) {
    gyroscope.learn(at(i), at(i + 1), Eigen::Quaterniond::Identity(), 0.005);
    if (i != 300) continue;
    const Eigen::Vector3d before = gyroscope.bias();
    // An earlier view was found again, which corrected a drift of 3 deg.
    gyroscope.learn(at(i + 0.1), at(i + 1), geometry::expSo3(Eigen::Vector3d(0.05, 0, 0)), 0.005);
    EXPECT_EQ(gyroscope.bias(), before);
  }
  EXPECT_LT((gyroscope.bias() - drifting(599)).norm(), 0.01) << gyroscope.bias().transpose();
}

TEST(Gyroscope, WhereReadingsAreMissingThereIsNoTurn) {
  Gyroscope gyroscope{{}};
  for (const double seconds : {0.0, 0.05, 0.1, 0.3, 0.35}) gyroscope.add(reading(seconds, {0, 0, 1}));
  EXPECT_TRUE(gyroscope.between(at(0), at(0.1)));
  EXPECT_TRUE(gyroscope.between(at(0.3), at(0.35)));
  EXPECT_FALSE(gyroscope.between(at(0), at(0.3)));
  EXPECT_FALSE(gyroscope.between(at(0.35), at(0.4)));
}

TEST(Gyroscope, OtherSensorsLateReadingsAndNonsenseAreLeftOut) {
  Gyroscope gyroscope{{}};
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  CObservationIMU blind;
  blind.timestamp = at(0);
  EXPECT_FALSE(gyroscope.add(blind)) << "it measures accelerations alone";
  EXPECT_FALSE(gyroscope.add(reading(0, {kNan, 0, 0})));
  EXPECT_FALSE(gyroscope.add(reading(0, {0, kInf, 0})));
  EXPECT_FALSE(gyroscope.add(reading(0, {0, 0, 1e6})));
  EXPECT_TRUE(gyroscope.add(reading(0, {0, 0, 1})));
  EXPECT_FALSE(gyroscope.add(reading(0.01, {0, 0, 1}, "another")));
  EXPECT_TRUE(gyroscope.add(reading(0.02, {0, 0, 1})));
  EXPECT_FALSE(gyroscope.add(reading(0.01, {0, 0, 1})));
  EXPECT_FALSE(gyroscope.add(reading(0.02, {0, 0, 1})));
  EXPECT_NEAR(geometry::logSo3(gyroscope.between(at(0), at(0.02))->begin_from_end).z(), 0.02, 1e-12);
}

}  // namespace
}  // namespace omnimapper::motion::gyroscope_test

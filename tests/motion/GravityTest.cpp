// Gravity from known accelerations.
#include <gtest/gtest.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/motion/Gravity.h>

#include <cmath>
#include <functional>
#include <limits>

namespace omnimapper::motion::gravity_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using namespace mrpt::obs;

constexpr double kDegree = 3.14159265358979323846 / 180, kGravity = 9.80665;

CObservationIMU reading(double seconds, const Vector3d& force, const Vector3d& rate = Vector3d::Zero()) {
  CObservationIMU imu;
  imu.timestamp = base::stampFromUnix(1e9 + seconds);
  imu.set(IMU_X_ACC, force.x());
  imu.set(IMU_Y_ACC, force.y());
  imu.set(IMU_Z_ACC, force.z());
  imu.set(IMU_WX, rate.x());
  imu.set(IMU_WY, rate.y());
  imu.set(IMU_WZ, rate.z());
  return imu;
}

double degreesFrom(const Gravity& gravity, const Vector3d& up) {
  return gravity.up ? std::atan2(gravity.up->cross(up).norm(), gravity.up->dot(up)) / kDegree : 999;
}

// Gravity from readings at 50 Hz. `rotation` is that of the base over time, `force` is in the base's frame.
Gravity estimated(double seconds, const std::function<Quaterniond(double)>& rotation,
                  const std::function<Vector3d(double)>& force) {
  SteadySpans spans;
  for (int i = 0; i < 50 * seconds; ++i) spans.add(reading(0.02 * i, force(0.02 * i)));
  std::vector<RotatedSpan> rotated;
  for (const auto& span : spans.all())
    rotated.push_back({rotation(base::secondsBetween(base::stampFromUnix(1e9), span.stamp)), span});
  return gravityOf(rotated);
}

const auto kNoTurn = [](double) { return Quaterniond::Identity(); };
const auto kLevelForce = [](double) { return Vector3d(0, 0, kGravity); };

TEST(Gravity, OfABaseThatIsTiltedBy30Deg) {
  const Quaterniond map_from_base(AngleAxisd(30 * kDegree, Vector3d::UnitX()));
  const auto gravity = estimated(
      5, [&](double) { return Quaterniond::Identity(); },
      [&](double) { return map_from_base.conjugate() * Vector3d(0, 0, kGravity); });
  EXPECT_LT(degreesFrom(gravity, Vector3d(0, 0.5, std::sqrt(0.75))), 1e-6) << gravity.reason;
  const auto known = estimated(
      5, [&](double) { return map_from_base; },
      [&](double) { return map_from_base.conjugate() * Vector3d(0, 0, kGravity); });
  EXPECT_LT(degreesFrom(known, Vector3d::UnitZ()), 1e-6);
  EXPECT_NEAR(known.magnitude, kGravity, 1e-9);
}

TEST(Gravity, TheSensorsPoseOnTheBaseCounts) {
  auto imu = reading(0, {0, 0, -kGravity});
  SteadySpans spans;
  for (int i = 0; i < 100; ++i) {
    imu.timestamp = base::stampFromUnix(1e9 + 0.02 * i);
    imu.sensorPose = mrpt::poses::CPose3D(0.1, 0, 0.3, 0, 0, 180 * kDegree);
    EXPECT_TRUE(spans.add(imu));
  }
  ASSERT_GT(spans.all().size(), 2U);
  EXPECT_LT((spans.all().front().force - Vector3d(0, 0, kGravity)).norm(), 1e-9) << "mounted upside down";
}

TEST(Gravity, InGIsTakenForSuchAndAnythingElseIsRefused) {
  const auto in_g = estimated(5, kNoTurn, [](double) { return Vector3d(0, 0, 1.01); });
  EXPECT_LT(degreesFrom(in_g, Vector3d::UnitZ()), 1e-6);
  EXPECT_NE(in_g.reason.find("assumed to be in g"), std::string::npos) << in_g.reason;
  const auto without = estimated(5, kNoTurn, [](double t) { return Vector3d(0.1 * std::sin(t), 0, 0.01); });
  EXPECT_FALSE(without.up);
  EXPECT_NE(without.reason.find("gravity was taken out"), std::string::npos) << without.reason;
  EXPECT_FALSE(estimated(5, kNoTurn, [](double) { return Vector3d(0, 0, 981); }).up);
}

// A bias of 0.3 m/s^2 is 1.7 deg. A base that turns about the vertical separates it from gravity; one that stands does
// not, and its covariance shows this.
TEST(Gravity, AConstantBiasIsSeparatedByTurning) {
  const Vector3d bias(0.3, -0.1, 0.05);
  const auto turning = [](double t) { return Quaterniond(AngleAxisd(0.3 * t, Vector3d::UnitZ())); };
  const auto force = [&](double) { return Vector3d(Vector3d(0, 0, kGravity) + bias); };
  const auto gravity = estimated(25, turning, force);
  EXPECT_LT(degreesFrom(gravity, Vector3d::UnitZ()), 0.15) << gravity.reason;
  const auto standing = estimated(25, kNoTurn, force);
  EXPECT_NEAR(degreesFrom(standing, Vector3d::UnitZ()), 1.85, 0.1);
  EXPECT_GT(std::sqrt(standing.covariance(0, 0)) / kDegree, 0.5);
  EXPECT_LT(std::sqrt(gravity.covariance(0, 0)) / kDegree, 0.3);
}

// In half of the time the base drives: it speeds up and brakes by 1.5 m/s^2, which is 9 deg.
TEST(Gravity, WhileDrivingIsOutweighedByStandingAndSlowDriving) {
  const auto force = [](double t) {
    const double phase = std::fmod(t, 8);
    const double along = phase < 1 ? 1.5 : phase >= 3 && phase < 4 ? -1.5 : 0;
    return Vector3d(along + 0.3 * std::sin(40 * t), 0.2 * std::cos(37 * t), kGravity);
  };
  const auto gravity = estimated(40, kNoTurn, force);
  EXPECT_LT(degreesFrom(gravity, Vector3d::UnitZ()), 0.3) << gravity.reason;
}

TEST(Gravity, ReadingsThatAreNoNumbersAndFastTurnsAreLeftOut) {
  SteadySpans spans;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(spans.add(reading(0, {nan, 0, kGravity})));
  EXPECT_FALSE(spans.add(reading(0, {0, std::numeric_limits<double>::infinity(), kGravity})));
  EXPECT_FALSE(spans.add(CObservationIMU()));
  for (int i = 0; i < 500; ++i) spans.add(reading(0.02 * i, {0, 0, kGravity}, {0, 0, 2}));
  EXPECT_TRUE(spans.all().empty());
  for (int i = 0; i < 500; ++i) spans.add(reading(20 + 0.3 * i, {0, 0, kGravity}));
  EXPECT_TRUE(spans.all().empty()) << "three readings in a second are too few";
  EXPECT_FALSE(gravityOf({}).up);
  EXPECT_FALSE(gravityOf({}).reason.empty());
}

}  // namespace
}  // namespace omnimapper::motion::gravity_test

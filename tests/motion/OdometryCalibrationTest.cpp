#include <gtest/gtest.h>
#include <mrpt/poses/CPose2D.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/motion/OdometryCalibration.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

namespace omnimapper::motion::odometry_calibration_test {
namespace {

using mrpt::math::TPose2D;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

/// Systematic errors of wheels: of the distance travelled as a share, of the heading for each metre [rad/m] and as a
/// share of the turn.
struct Errors {
  double travel = 0, turn_per_m = 0, turn = 0;

  TPose2D measured(const TPose2D& actual) const {
    return {(1 + travel) * actual.x, actual.y, actual.phi + turn_per_m * actual.x + turn * actual.phi};
  }
};

/// The calibration after steps of 0.1 m, straight ahead and round curves, with the random errors of good wheels.
OdometryCalibration learnt(const Errors& errors, double metres, std::uint64_t seed = 1) {
  OdometryCalibration calibration;
  testing::Dice dice(seed);
  for (int i = 0; i < static_cast<int>(10 * metres); ++i) {
    const TPose2D actual(0.1, 0, i / 20 % 2 == 0 ? 0 : 0.08);
    TPose2D measured = errors.measured(actual);
    measured.x += dice.normal(0.005 * std::sqrt(0.1));
    measured.phi += dice.normal(0.005 * std::sqrt(0.1));
    calibration.learn(measured, actual);
  }
  return calibration;
}

TEST(OdometryCalibration, LeavesAsItIsWhatItKnowsNothingOf) {
  const TPose2D measured(0.3, -0.01, 0.2), given = OdometryCalibration().applied(measured);
  EXPECT_EQ(given.x, measured.x);
  EXPECT_EQ(given.y, measured.y);
  EXPECT_EQ(given.phi, measured.phi);
}

// After 40 m, of which 25 count, less than half of the error is left; after half a metre it is half or more.
TEST(OdometryCalibration, LearnsTravelAndTurnErrorsWithinSomeMetres) {
  for (const auto& errors : {Errors{0.05, 0, 0}, Errors{0, 2 * kDegree, 0}, Errors{-0.03, -1 * kDegree, 0.05}}) {
    const TPose2D actual(10, 0, 1);
    const auto off = [&](const OdometryCalibration& calibration) {
      const TPose2D given = calibration.applied(errors.measured(actual));
      return std::hypot(given.x - actual.x, 5 * (given.phi - actual.phi));
    };
    const double untaught = off(OdometryCalibration());
    EXPECT_LT(off(learnt(errors, 40)), 0.45 * untaught);
    EXPECT_GT(off(learnt(errors, 0.5)), 0.5 * untaught) << "half a metre proves little";
  }
}

TEST(OdometryCalibration, IsThatOfDrivingBackwardsToo) {
  const Errors errors{0.04, 2 * kDegree, 0};
  const auto calibration = learnt(errors, 40);
  const TPose2D given = calibration.applied(errors.measured({-10, 0, 0}));
  EXPECT_NEAR(given.x, -10, 0.1);
  EXPECT_NEAR(given.phi, 0, 9 * kDegree) << "20 deg as measured";
}

TEST(OdometryCalibration, LearnsNothingOfSlip) {
  OdometryCalibration calibration;
  for (int i = 0; i < 1000; ++i) calibration.learn({0.3, 0, 1.5}, {0, 0, 0});
  for (int i = 0; i < 1000; ++i) calibration.learn({0.3, 0, 1.5}, {0.3, 0, 0});
  calibration.learn({std::nan(""), 0, 0}, {0.1, 0, 0});
  EXPECT_EQ(calibration.applied({1, 0, 0.1}).phi, 0.1);
  EXPECT_EQ(calibration.applied({1, 0, 0.1}).x, 1);
}

TEST(OdometryCalibration, Fades) {
  auto calibration = learnt({0.05, 0, 0}, 100);
  ASSERT_NEAR(calibration.applied({1.05, 0, 0}).x, 1, 0.01);
  for (int i = 0; i < 3000; ++i) calibration.learn({0.1, 0, 0}, {0.1, 0, 0});
  EXPECT_NEAR(calibration.applied({1, 0, 0}).x, 1, 0.002);
}

}  // namespace
}  // namespace omnimapper::motion::odometry_calibration_test

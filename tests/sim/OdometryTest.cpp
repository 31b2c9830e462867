#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Drive.h>

#include <nlohmann/json.hpp>

#include "SensorRun.h"
#include "SmallWorlds.h"

namespace odometry_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;
using Reading = mrpt::obs::CObservationOdometry;

const std::string exact =
    "class = Odometry\nradius_bias = 0\nbase_bias = 0\nslip_per_root_m = 0\nturn_slip_per_root_m_deg = 0\n"
    "turn_slip_per_root_turn = 0\nrate_hz = 20\n";

sim::Track tour(const sim::World& world) {
  return sim::planDrive(base::Config::fromText("[robot]\n", "test.ini"), world);
}

sim::Track straight(double length) {
  return {sim::Track::Kind::motion, {{0, at(0, 0)}, {length, at(length, 0)}}};
}

// Turns on the spot, so slowly that consecutive readings differ by less than half a turn.
sim::Track spinning(int turns) {
  std::vector<sim::Track::Place> places;
  for (int i = 0; i <= 8 * turns; ++i) places.push_back({static_cast<double>(i), at(0, 0, 0, i * M_PI / 4)});
  return {sim::Track::Kind::motion, places};
}

TEST(Odometry, withoutErrorsIsTheTrajectory) {
  const sim::Track track = tour(threeRooms());
  const double end = track.places().back().time;
  const SensorRun run(threeRooms(), track, exact, end);
  const geometry::Se2 start = geometry::project(*track.at(0));
  geometry::Se2 summed = start;
  for (int k = 0; k < run.sensor().count(); ++k) {
    const auto reading = run.measure<Reading>(k);
    const geometry::Se2 truth = geometry::project(*track.at(run.sensor().timeOf(k)));
    const geometry::Se2 measured = start * geometry::fromMrpt(reading->odometry);
    EXPECT_LT(geometry::minus(measured, truth).norm(), 1e-6);
    const auto increment = nlohmann::json::parse(run.truth(k))["increment"];
    summed = summed * geometry::Se2{increment[0], increment[1], increment[2]};
    EXPECT_LT(geometry::minus(summed, truth).norm(), 5e-3);
    EXPECT_TRUE(reading->hasVelocities);
    EXPECT_FALSE(reading->hasEncodersInfo);
  }
}

TEST(Odometry, velocitiesAreThoseOfTheBase) {
  const SensorRun run(oneRoom(6, 4), straight(10), exact, 10);
  const auto reading = run.measure<Reading>(50);
  EXPECT_NEAR(reading->velocityLocal.vx, 1, 1e-9);
  EXPECT_NEAR(reading->velocityLocal.omega, 0, 1e-9);
}

/// Variance over seeds of the end of a track, of x and yaw, about the true end.
struct Spread {
  double distance = 0, yaw = 0;
};
Spread spreadOver(int seeds, const sim::Track& track, double duration, const std::string& keys) {
  Spread spread;
  const geometry::Se2 start = geometry::project(*track.at(0)), end = geometry::project(*track.at(duration));
  for (int seed = 0; seed < seeds; ++seed) {
    const SensorRun run(oneRoom(6, 4), track, exact + keys, duration, 1000 + seed);
    const auto last = run.measure<Reading>(run.sensor().count() - 1);
    const Eigen::Vector3d error = geometry::minus(geometry::fromMrpt(last->odometry), geometry::inverse(start) * end);
    spread.distance += error.x() * error.x() / seeds;
    spread.yaw += error.z() * error.z() / seeds;
  }
  return spread;
}

// With 200 seeds the relative error of a variance has standard deviation sqrt(2 / 200); 95 % lie within 1.96 of that.
constexpr int kSeeds = 200;
const double kBound = 1.96 * std::sqrt(2.0 / kSeeds);

TEST(Odometry, slipHasTheVarianceThatItsOptionsClaim) {
  const Spread along = spreadOver(kSeeds, straight(20), 20, "slip_per_root_m = 0.01");
  EXPECT_NEAR(along.distance / (0.01 * 0.01 * 20), 1, kBound);
  const Spread aside = spreadOver(kSeeds, straight(20), 20, "turn_slip_per_root_m_deg = 0.5");
  EXPECT_NEAR(aside.yaw / (std::pow(0.5 * M_PI / 180, 2) * 20), 1, kBound);
  const Spread turned = spreadOver(kSeeds, spinning(4), 32, "turn_slip_per_root_turn = 0.02");
  EXPECT_NEAR(turned.yaw / (0.02 * 0.02 * 8 * M_PI), 1, kBound);
}

TEST(Odometry, biasGrowsWithTheWayNotItsRoot) {
  // The distance has the mean of the two wheels' errors, the heading their difference over the base of 0.5 m.
  const Spread bias = spreadOver(kSeeds, straight(4), 4, "radius_bias = 0.01");
  EXPECT_NEAR(bias.yaw / (2 * std::pow(0.01 * 4 / 0.5, 2)), 1, kBound);
  const Spread base = spreadOver(kSeeds, spinning(1), 7, "base_bias = 0.02");
  EXPECT_NEAR(base.yaw / std::pow(0.02 * 7 * M_PI / 4, 2), 1, kBound);
}

TEST(Odometry, encodersCountWhatTheWheelsRolled) {
  const SensorRun run(oneRoom(6, 4), straight(2), exact + "ticks_per_m = 1000", 2);
  const auto last = run.measure<Reading>(run.sensor().count() - 1);
  EXPECT_TRUE(last->hasEncodersInfo);
  EXPECT_EQ(last->encoderLeftTicks, 2000);
  EXPECT_EQ(last->encoderRightTicks, 2000);
  const SensorRun spin(oneRoom(6, 4), spinning(1), exact + "ticks_per_m = 1000\nwheel_base_m = 0.4", 4);
  const auto turned = spin.measure<Reading>(spin.sensor().count() - 1);
  EXPECT_EQ(turned->encoderRightTicks, std::lround(1000 * M_PI * 0.2));
  EXPECT_EQ(turned->encoderLeftTicks, -std::lround(1000 * M_PI * 0.2));
}

}  // namespace
}  // namespace odometry_test

#include <BeaconPayload.h>
#include <gtest/gtest.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "../plugin/GraphInvariants.h"

// Delays every observation of a log, including odometry, by a random time of up to several windows.
namespace omnimapper::mapper::shuffled_arrival_test {
namespace {

using mrpt::obs::CObservation;
using testing::makeEngine;
using testing::SimulatedLog;
using testing::SimulatedLogOptions;

constexpr double kWindow = 0.5;      // [s] of the engine's queue
constexpr double kLongestDelay = 2;  // [s]
constexpr int kSeeds = testing::kIsSanitized ? 5 : 50;

std::vector<CObservation::Ptr> shuffled(const std::vector<CObservation::Ptr>& log, std::uint64_t seed) {
  testing::Dice dice(seed);
  std::multimap<base::Stamp, CObservation::Ptr> arrivals;
  for (const auto& observation : log) {
    arrivals.emplace(observation->timestamp + base::durationFromSeconds(dice.uniform(0, kLongestDelay)), observation);
  }
  std::vector<CObservation::Ptr> arrived;
  for (const auto& [stamp, observation] : arrivals) arrived.push_back(observation);
  return arrived;
}

// Describes every factor by its measurement and the stamps of what it binds; landmarks by their name.
std::multiset<std::string> factorsByStamp(const View& view) {
  std::map<base::VariableId, std::string> names;
  for (const auto& frame : view.map.key_frames) names[frame.pose] = base::formatUnix(frame.stamp, 7);
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto& payload = dynamic_cast<const beacons::BeaconPayload&>(*landmark.payload);
    for (const auto variable : landmark.variables) names[variable] = "beacon " + std::to_string(payload.number);
  }
  std::multiset<std::string> all;
  for (const auto& [id, record] : view.graph.factors()) {
    std::ostringstream text;
    text << record.tags.owner << " " << record.factor->kind();
    for (const auto variable : record.variables) text << " " << (names.count(variable) ? names[variable] : "other");
    all.insert(text.str());
  }
  return all;
}

const std::string kKnownIdentityIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = tracker, beacons
[trigger]
every_observation = true
[solver]
final_max_iterations = 200
final_tolerance      = 1e-14
[odometry]
class = OdometryPlugin
[tracker]
class = RobotPosePlugin
reference_is_map = false
loss_scale       = 1000
[beacons]
class                  = BeaconPlugin
height_m               = 1.4
association_confidence = 0.999999999
association_inflation  = 100
)";

TEST(ShuffledArrival, WithKnownIdentitiesTheGraphIsThatOfTheOrderedRun) {
  SimulatedLogOptions options;
  options.lasers.clear();
  options.tracker.on = true;
  options.tracker.rate = 5;
  options.beacons.on = true;
  const auto log = SimulatedLog(options).observations();
  const auto ordered = makeEngine(kKnownIdentityIni);
  testing::run(*ordered, log);
  const auto expected = factorsByStamp(ordered->view());
  const double chi2 = ordered->view().graph.chi2();
  ASSERT_GT(expected.size(), 50U);
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto engine = makeEngine(kKnownIdentityIni);
    testing::run(*engine, shuffled(log, static_cast<std::uint64_t>(seed)));
    const auto view = engine->view();
    EXPECT_EQ(view.map.landmarks.size(), ordered->view().map.landmarks.size());
    EXPECT_EQ(view.graph.variables().size(), ordered->view().graph.variables().size());
    EXPECT_TRUE(factorsByStamp(view) == expected);
    EXPECT_NEAR(view.graph.chi2() / chi2, 1, 1e-9);
    EXPECT_GT(view.counts.spliced, 5U) << "else the test shows nothing";
    testing::expectOneChain(view, {"odometry"});
    testing::expectNothingDangles(view);
    if (HasFailure()) FAIL() << "with seed " << seed;
  }
}

// One log is not enough: the error of a single map is mostly noise. The mean over ten logs is meaningful.
TEST(ShuffledArrival, WithLoopClosuresTheTrajectoryIsAsGoodAndNoOdometryIsUsedTwice) {
  constexpr int kLogs = testing::kIsSanitized ? 1 : 10;
  double ordered_sum = 0, shuffled_sum = 0;
  for (int number = 1; number <= kLogs; ++number) {
    SimulatedLogOptions options;
    options.laps = 1.2;
    options.lasers.front().rate = 1.6;  // nearly every scan earns a key frame
    options.seed = static_cast<std::uint64_t>(number);
    const SimulatedLog simulated(options);
    const auto log = simulated.observations();
    const std::vector<std::string> wheels{"mapper.pose_plugins=odometry, no_motion"};
    const auto ordered = makeEngine(testing::kLaserIni, wheels);
    testing::run(*ordered, log);
    ordered_sum += testing::trajectoryError(ordered->view(), simulated);
    for (int seed = number; seed <= kSeeds; seed += kLogs) {
      const auto engine = makeEngine(testing::kLaserIni, wheels);
      testing::run(*engine, shuffled(log, static_cast<std::uint64_t>(seed)));
      shuffled_sum += testing::trajectoryError(engine->view(), simulated);
      testing::expectOneChain(engine->view(), {"odometry", "no_motion"});
      EXPECT_GT(engine->view().counts.spliced, 5U) << "else the test shows nothing";
    }
  }
  RecordProperty("ordered_error_m", std::to_string(ordered_sum / kLogs));
  RecordProperty("shuffled_error_m", std::to_string(shuffled_sum / kSeeds));
  if (testing::kIsSanitized) GTEST_SKIP() << "the mean over one log says little: the release build judges ten";
  EXPECT_LT(shuffled_sum / kSeeds, 1.05 * ordered_sum / kLogs);
}

// Laser odometry skips scans that come after their time, and bridges the gap.
TEST(ShuffledArrival, LaserOdometryIsNearlyAsGoodAndFarBetterThanWheelsInOrder) {
  constexpr int kLogs = testing::kIsSanitized ? 1 : 10;
  double wheels_sum = 0, ordered_sum = 0, shuffled_sum = 0;
  for (int number = 1; number <= kLogs; ++number) {
    SimulatedLogOptions options;
    options.laps = 1.2;
    options.seed = static_cast<std::uint64_t>(number);
    const SimulatedLog simulated(options);
    const auto log = simulated.observations();
    const auto wheels = makeEngine(testing::kLaserIni, {"mapper.pose_plugins=odometry, no_motion"});
    testing::run(*wheels, log);
    wheels_sum += testing::trajectoryError(wheels->view(), simulated);
    const auto ordered = makeEngine(testing::kLaserIni);
    testing::run(*ordered, log);
    ordered_sum += testing::trajectoryError(ordered->view(), simulated);
    const auto engine = makeEngine(testing::kLaserIni);
    testing::run(*engine, shuffled(log, options.seed));
    shuffled_sum += testing::trajectoryError(engine->view(), simulated);
    testing::expectOneChain(engine->view(), {"scan_odometry", "odometry", "no_motion"});
    testing::expectNothingDangles(engine->view());
    EXPECT_GT(engine->view().counts.late, log.size() / 10) << "else the test shows nothing";
  }
  RecordProperty("wheels_error_m", std::to_string(wheels_sum / kLogs));
  RecordProperty("ordered_error_m", std::to_string(ordered_sum / kLogs));
  RecordProperty("shuffled_error_m", std::to_string(shuffled_sum / kLogs));
  EXPECT_LT(shuffled_sum, 0.2 * wheels_sum);
  if (testing::kIsSanitized) GTEST_SKIP() << "the mean over one log says little: the release build judges ten";
  EXPECT_LT(shuffled_sum, 1.5 * ordered_sum);
}

}  // namespace
}  // namespace omnimapper::mapper::shuffled_arrival_test

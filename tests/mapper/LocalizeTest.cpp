#include <gtest/gtest.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <cmath>

// Localizes a log in a map, with the plugins of the project.
namespace omnimapper::mapper::localize_test {
namespace {

using testing::SimulatedLog;
using testing::SimulatedLogOptions;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

constexpr int kFreeKeyFrames = 20;

SimulatedLogOptions ring(double laps, std::uint64_t seed) {
  SimulatedLogOptions options;
  options.laps = laps;
  options.seed = seed;
  return options;
}

class Localize : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::ScratchFolder>();
    mapped_ = std::make_unique<SimulatedLog>(ring(1.2, 1));
    const auto engine = testing::makeEngine(testing::kLaserIni);
    testing::run(*engine, mapped_->observations());
    const auto view = engine->view();
    derived::mapFileToAsk(view).write(*folder_ / "map.omnimap");
  }
  static void TearDownTestSuite() {
    folder_.reset();
    mapped_.reset();
  }
  static derived::SavedMap saved() { return derived::readMap(*folder_ / "map.omnimap", registeredKinds()); }

  // Another drive through the same ring, from its start.
  std::unique_ptr<Engine> localize(const Observations& observations, int threads = 1) {
    auto map = saved();
    SessionOptions session;
    session.start = SessionOptions::Start::origin;
    const auto start = session.startOn(map.map);
    auto engine = testing::makeEngine(testing::kLaserIni, {}, threads, true);
    engine->sessions().localizeIn(std::move(map), start, kFreeKeyFrames);
    testing::run(*engine, observations);
    return engine;
  }

  static inline std::unique_ptr<testing::ScratchFolder> folder_;
  static inline std::unique_ptr<SimulatedLog> mapped_;
};

// Root mean square error [m] of the estimates that were known when each key frame came.
double errorOf(const std::vector<LocalizationEstimate>& estimates, const SimulatedLog& log) {
  double sum = 0, count = 0;
  for (const auto& estimate : estimates) {
    if (!estimate.located()) continue;
    const mrpt::poses::CPose3D truth(log.truthAt(estimate.stamp) - log.truthAt(log.begin()));
    sum += (truth.translation() - estimate.map_from_base.translation()).sqrNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST_F(Localize, AnotherDriveIsLocatedAsWellAsTheMapIsKnown) {
  const SimulatedLog log(ring(2, 7));
  const auto engine = localize(log.observations());
  const auto view = engine->view();
  EXPECT_TRUE(view.map_is_held);
  ASSERT_GT(view.localization.size(), 50U);
  const auto located = std::count_if(view.localization.begin(), view.localization.end(),
                                     [](const LocalizationEstimate& estimate) { return estimate.located(); });
  EXPECT_GT(static_cast<double>(located), 0.9 * static_cast<double>(view.localization.size()));
  const double error = errorOf(view.localization, log);
  RecordProperty("rmse_m", std::to_string(error));
  EXPECT_LT(error, 0.1);
  EXPECT_LT(std::sqrt((*view.localization.back().covariance)(0, 0)), 0.1);
}

TEST_F(Localize, TheMapStaysAsItWasAndOnlyTheWindowIsFree) {
  const SimulatedLog log(ring(3, 7));
  const auto engine = localize(log.observations());
  const auto view = engine->view();
  const auto map = saved();
  for (const auto& frame : map.map.key_frames) {
    EXPECT_EQ(view.graph.value(frame.pose), map.graph.value(frame.pose)) << frame.id;
  }
  std::size_t free = 0, kept = 0;
  for (const auto& [id, record] : view.graph.variables()) free += !record.fixed;
  for (const auto& frame : view.map.key_frames) kept += frame.id.session == 1 && !frame.observations.empty();
  // The key frames within the horizon of late data, the one before them, and those that wait for their perception.
  std::size_t most = kFreeKeyFrames;
  const auto newest = view.map.key_frames.back().stamp;
  for (const auto& frame : view.map.key_frames) {
    const bool is_own = frame.id.session == 1;
    most += is_own && base::secondsBetween(frame.stamp, newest) < EngineOptions().horizon;
  }
  EXPECT_GT(view.localization.size(), 2 * most);
  EXPECT_LE(free, most);
  EXPECT_LE(kept, most) << "scans of what left the window are let go";
  EXPECT_LT(view.graph.factors().size(), 6 * most);
}

TEST_F(Localize, InEveryBitTheSameWithMoreThreads) {
  const auto observations = SimulatedLog(ring(0.7, 7)).observations();
  const auto once = localize(observations), again = localize(observations, 3);
  EXPECT_TRUE(testing::bitsOf(once->view()) == testing::bitsOf(again->view()));
}

TEST_F(Localize, WhatComesTooLateForTheWindowIsRefusedAndCounted) {
  const SimulatedLog log(ring(1.5, 7));
  auto observations = log.observations();
  const auto early = std::find_if(observations.begin(), observations.end(), [&](const auto& observation) {
    return observation->sensorLabel == "laser" && base::secondsBetween(log.begin(), observation->timestamp) > 10;
  });
  const auto late = *early;
  observations.erase(early);
  observations.push_back(late);
  const auto engine = localize(observations);
  EXPECT_EQ(engine->view().counts.too_late, 1U);
  EXPECT_LT(errorOf(engine->view().localization, log), 0.1);
}

// Without scans and closures, the map and the log share only the earth.
TEST_F(Localize, ByGpsAloneFromAStartThatIsFarOff) {
  auto options = ring(1, 1);
  options.lasers.clear();
  options.gps.on = true;
  const SimulatedLog mapped(options);
  options.seed = 7;
  const SimulatedLog log(options);
  const std::string ini =
      "[mapper]\npose_plugins = odometry\nmeasurement_plugins = gps\n[odometry]\nclass = OdometryPlugin\n[gps]\n"
      "class = GpsPlugin\n";
  const auto mapping = testing::makeEngine(ini);
  testing::run(*mapping, mapped.observations());
  const auto view = mapping->view();
  derived::mapFileToAsk(view).write(*folder_ / "gps.omnimap");
  auto map = derived::readMap(*folder_ / "gps.omnimap", registeredKinds());
  SessionOptions session;
  session.start = SessionOptions::Start::pose;
  session.start_x = 30, session.start_y = -20, session.start_yaw = 2;
  const auto start = session.startOn(map.map);
  const auto engine = testing::makeEngine(ini, {}, 1, true);
  engine->sessions().localizeIn(std::move(map), start, kFreeKeyFrames);
  testing::run(*engine, log.observations());
  const auto& estimates = engine->view().localization;
  const auto located = std::count_if(estimates.begin(), estimates.end(),
                                     [](const LocalizationEstimate& estimate) { return estimate.located(); });
  EXPECT_GT(static_cast<double>(located), 0.5 * static_cast<double>(estimates.size()));
  EXPECT_LT(errorOf(estimates, log), 0.5);
}

// A session that is not tied to the map may lie anywhere, so being located in it means nothing.
TEST_F(Localize, ASessionOfTheMapThatWasNeverAlignedIsNoPlaceToBeLocatedIn) {
  SimulatedLogOptions elsewhere;
  elsewhere.place = SimulatedLogOptions::Place::box;
  const SimulatedLog box(elsewhere);
  auto first = saved();
  const auto begin = SessionOptions().startOn(first.map);
  const auto both = testing::makeEngine(testing::kLaserIni);
  both->sessions().continueFrom(std::move(first), begin);
  testing::run(*both, box.observations());
  ASSERT_FALSE(both->view().map.sessions.back().aligned);
  const auto view = both->view();
  derived::mapFileToAsk(view).write(*folder_ / "apart.omnimap");
  auto map = derived::readMap(*folder_ / "apart.omnimap", registeredKinds());
  SessionStart start{map.map.key_frames[saved().map.key_frames.size()].map_from_base, 1, 0.5};
  const auto engine = testing::makeEngine(testing::kLaserIni, {}, 1, true);
  engine->sessions().localizeIn(std::move(map), start, kFreeKeyFrames);
  testing::run(*engine, box.observations());
  for (const auto& estimate : engine->view().localization) EXPECT_FALSE(estimate.located()) << estimate.key_frame;
}

}  // namespace
}  // namespace omnimapper::mapper::localize_test

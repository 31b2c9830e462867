#include <gtest/gtest.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <cmath>

// Continues logs that were cut, through a map file and with the plugins of the project.
namespace omnimapper::mapper::continue_test {
namespace {

using mrpt::poses::CPose3D;
using testing::SimulatedLog;
using testing::SimulatedLogOptions;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

SimulatedLogOptions ring(double laps) {
  SimulatedLogOptions options;
  options.laps = laps;
  return options;
}

// The observations of the log before that part, and those after it.
std::pair<Observations, Observations> cut(const SimulatedLog& log, double part) {
  const auto stamp = log.begin() + base::durationFromSeconds(part * base::secondsBetween(log.begin(), log.end()));
  std::pair<Observations, Observations> halves;
  for (const auto& observation : log.observations()) {
    (observation->timestamp < stamp ? halves.first : halves.second).push_back(observation);
  }
  return halves;
}

class Continue : public ::testing::Test {
 protected:
  std::unique_ptr<Engine> map(const Observations& observations) {
    auto engine = testing::makeEngine(ini_, settings_);
    testing::run(*engine, observations);
    return engine;
  }
  std::unique_ptr<Engine> goOn(const Engine& before, const Observations& observations) {
    const auto view = before.view();
    derived::mapFileToAsk(view).write(path_);
    auto saved = derived::readMap(path_, registeredKinds());
    const auto start = start_.startOn(saved.map);
    auto engine = testing::makeEngine(ini_, settings_);
    engine->sessions().continueFrom(std::move(saved), start);
    testing::run(*engine, observations);
    return engine;
  }

  std::string ini_ = testing::kLaserIni;
  std::vector<std::string> settings_;
  SessionOptions start_;
  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "map.omnimap";
};

TEST_F(Continue, ALogCutInTwoGivesTheMapOfTheLogInOnePiece) {
  const SimulatedLog log(ring(2));
  const auto whole = map(log.observations());
  const double error = testing::trajectoryError(whole->view(), log);
  for (const double part : {0.5, 0.7}) {
    const auto [first, second] = cut(log, part);
    const auto both = goOn(*map(first), second);
    const auto view = both->view();
    ASSERT_EQ(view.map.sessions.size(), 2U);
    EXPECT_TRUE(view.map.sessions[1].aligned) << part;
    ASSERT_TRUE(view.map.sessions[1].aligned_at);
    EXPECT_EQ(view.map.sessions[1].aligned_at->session, 1);
    EXPECT_NEAR(static_cast<double>(view.map.key_frames.size()),
                static_cast<double>(whole->view().map.key_frames.size()), 2);
    const double error_of_both = testing::trajectoryError(view, log);
    RecordProperty("ate_whole_m", std::to_string(error));
    RecordProperty("ate_cut_m", std::to_string(error_of_both));
    EXPECT_NEAR(error_of_both, error, 0.03) << part;
  }
}

TEST_F(Continue, ItsStampsMayBeEarlierThanThoseOfTheMap) {
  const SimulatedLog log(ring(2));
  const auto [first, second] = cut(log, 0.5);
  const auto before = map(first);
  const auto later = goOn(*before, second);
  for (const auto& observation : second) observation->timestamp -= base::durationFromSeconds(86400);
  const auto earlier = goOn(*before, second);
  const auto &a = later->view().map.key_frames, &b = earlier->view().map.key_frames;
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(earlier->view().map.sessions[1].aligned);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_LT((a[i].map_from_base.translation() - b[i].map_from_base.translation()).norm(), 1e-6);
  }
}

TEST_F(Continue, ASessionThatMayBeAnywhereIsFoundInTheMap) {
  const SimulatedLog log(ring(2));
  const auto whole = map(log.observations());
  const double error = testing::trajectoryError(whole->view(), log);
  const auto before = map(cut(log, 0.5).first);
  start_.start = SessionOptions::Start::anywhere;
  for (const double begin : {0.5, 0.6, 0.72, 0.85}) {  // share of the log at which the second session begins
    const auto both = goOn(*before, cut(log, begin).second);
    EXPECT_TRUE(both->view().map.sessions[1].aligned) << begin;
    EXPECT_NEAR(testing::trajectoryError(both->view(), log), error, 0.03) << begin;
  }
}

TEST_F(Continue, ASessionOfAnotherBuildingIsNotAlignedAndTheMapStaysAsItWas) {
  const auto before = map(SimulatedLog(ring(1)).observations());
  SimulatedLogOptions other;
  other.place = SimulatedLogOptions::Place::box;
  other.laps = 3;
  start_.start = SessionOptions::Start::anywhere;
  const auto both = goOn(*before, SimulatedLog(other).observations());
  EXPECT_FALSE(both->view().map.sessions[1].aligned);
  for (const auto& frame : before->view().map.key_frames) {
    const CPose3D moved = both->view().map.keyFrame(frame.id).map_from_base - frame.map_from_base;
    EXPECT_LT(moved.translation().norm(), 1e-3) << frame.id;
  }
  const auto& decisions = both->view().decisions;
  EXPECT_TRUE(std::any_of(decisions.begin(), decisions.end(), [](const auto& decision) {
    return decision.kind == "relocalization" && !decision.accepted && !decision.reason.empty();
  }));
}

TEST_F(Continue, AStartThatIsWrongByFarIsSetRightInTheWholeMap) {
  const SimulatedLog log(ring(2));
  const auto [first, second] = cut(log, 0.5);
  start_.start = SessionOptions::Start::pose;
  start_.start_x = 30, start_.start_y = 40, start_.start_yaw = 3;  // beyond the area that is searched around the start
  const auto both = goOn(*map(first), second);
  EXPECT_TRUE(both->view().map.sessions[1].aligned);
  EXPECT_LT(testing::trajectoryError(both->view(), log), 0.1);
}

// Walls fit many places, and a single one that ties a session to the wrong place would end the search of other plugins.
TEST_F(Continue, ALogThatBeginsWhereNobodySaidIsFoundAndHasItsWallsOnce) {
  ini_ += "[laser_lines]\nclass = LaserLineExtractor\n[planes]\nclass = PlaneLandmarksPlugin\n";
  settings_ = {"mapper.measurement_plugins=planes,loop_closure", "perception.extractors=laser_points,laser_lines"};
  const SimulatedLog log(ring(1.5));  // it ends half a lap from its begin, and the session should begin there
  const auto before = map(log.observations());
  const auto walls = [](const View& view) {
    int count = 0;
    for (const auto& [id, landmark] : view.map.landmarks) count += landmark.state == map::Landmark::State::active;
    return count;
  };
  const auto both = goOn(*before, log.observations());
  ASSERT_TRUE(both->view().map.sessions[1].aligned);
  EXPECT_LT(testing::trajectoryError(both->view(), log), 0.1);
  EXPECT_LE(walls(both->view()), walls(before->view()) + 1);
}

TEST_F(Continue, AStartThatIsOffIsSetRight) {
  const SimulatedLog log(ring(2));
  const auto [first, second] = cut(log, 0.5);
  start_.start = SessionOptions::Start::pose;
  for (const double metres : {0.5, 2.5, 5.0}) {
    start_.start_x = 0.8 * metres, start_.start_y = 0.6 * metres, start_.start_yaw = 0.2;
    start_.start_sigma = std::max(1.0, metres / 2);
    const auto both = goOn(*map(first), second);
    EXPECT_TRUE(both->view().map.sessions[1].aligned) << metres;
    EXPECT_LT(testing::trajectoryError(both->view(), log), 0.1) << metres;
  }
}

TEST_F(Continue, AThirdSessionGoesOnFromTheSecond) {
  const SimulatedLog log(ring(3));
  const auto [first, rest] = cut(log, 1.0 / 3);
  const auto middle = rest.begin() + static_cast<std::ptrdiff_t>(rest.size() / 2);
  const auto three = goOn(*goOn(*map(first), {rest.begin(), middle}), {middle, rest.end()});
  const auto view = three->view();
  ASSERT_EQ(view.map.sessions.size(), 3U);
  EXPECT_TRUE(view.map.sessions[1].aligned);
  EXPECT_TRUE(view.map.sessions[2].aligned);
  EXPECT_EQ(view.map.key_frames.back().id.session, 2);
  EXPECT_LT(testing::trajectoryError(view, log), 0.1);
}

TEST_F(Continue, TheMapOfTwoSessionsIsTheSameInEveryBitWithMoreThreads) {
  const SimulatedLog log(ring(1.5));
  const auto [first, second] = cut(log, 0.65);
  const auto before = map(first);
  start_.start = SessionOptions::Start::anywhere;
  const auto once = goOn(*before, second);
  auto saved = derived::readMap(path_, registeredKinds());
  const auto start = start_.startOn(saved.map);
  const auto again = testing::makeEngine(ini_, settings_, 3);
  again->sessions().continueFrom(std::move(saved), start);
  testing::run(*again, second);
  EXPECT_TRUE(testing::bitsOf(once->view()) == testing::bitsOf(again->view()));
}

TEST_F(Continue, ASectionOfNobodyHereSurvivesTwoSessions) {
  const SimulatedLog log(ring(0.6));
  const auto [first, rest] = cut(log, 0.5);
  const auto middle = rest.begin() + static_cast<std::ptrdiff_t>(rest.size() / 2);
  const auto begun = map(first);
  auto view = begun->view();
  auto file = derived::mapFileOf(view.map, view.graph);
  file.set({"plugin stranger", 4, std::string("x\0y", 3)});
  file.write(path_);
  auto saved = derived::readMap(path_, registeredKinds());
  const auto start = start_.startOn(saved.map);
  auto second = testing::makeEngine(ini_);
  second->sessions().continueFrom(std::move(saved), start);
  testing::run(*second, {rest.begin(), middle});
  const auto third = goOn(*second, {middle, rest.end()});
  const auto stranger = third->view().map.layers.find("plugin stranger");
  ASSERT_TRUE(stranger);
  EXPECT_EQ(stranger->version(), 4U);
  EXPECT_EQ(stranger->bytes(), std::string("x\0y", 3));
}

// Without scans and closures, the two sessions share only the earth or the frame of the tracker.
class ContinueWithReference : public Continue {
 protected:
  // Variables that are neither the pose of a key frame nor an anchor.
  static std::size_t countReferences(const View& view) {
    std::size_t count = 0;
    for (const auto& [id, record] : view.graph.variables()) {
      const auto& frames = view.map.key_frames;
      const auto& sessions = view.map.sessions;
      count += std::none_of(frames.begin(), frames.end(), [id = id](const auto& f) { return f.pose == id; }) &&
               std::none_of(sessions.begin(), sessions.end(), [id = id](const auto& s) { return s.anchor == id; });
    }
    return count;
  }
  static SimulatedLogOptions ringWithoutLaser() {
    auto options = ring(2);
    options.lasers.clear();
    return options;
  }
};

TEST_F(ContinueWithReference, GpsGoesOnWithTheSameOriginAndFrame) {
  auto options = ringWithoutLaser();
  options.gps.on = true;
  const SimulatedLog log(options);
  ini_ =
      "[mapper]\npose_plugins = odometry\nmeasurement_plugins = gps\n[odometry]\nclass = OdometryPlugin\n[gps]\n"
      "class = GpsPlugin\n";
  const auto [first, second] = cut(log, 0.6);
  const auto before = map(first);
  start_.start = SessionOptions::Start::pose;
  start_.start_x = 30, start_.start_y = -20, start_.start_yaw = 2;  // far off: the GPS fixes determine the place
  const auto both = goOn(*before, second);
  EXPECT_EQ(countReferences(before->view()), 1U);
  EXPECT_EQ(countReferences(both->view()), 1U);
  EXPECT_TRUE(both->view().map.sessions[1].aligned);
  EXPECT_LT(testing::trajectoryError(both->view(), log), testing::trajectoryError(before->view(), log) + 0.1);
  settings_ = {"gps.map_is_enu=true"};
  EXPECT_THROW(goOn(*before, second), base::Error) << "the map is not east-north-up";
}

TEST_F(ContinueWithReference, ATrackerGoesOnInTheSameFrame) {
  auto options = ringWithoutLaser();
  options.tracker.on = true;
  const SimulatedLog log(options);
  ini_ =
      "[mapper]\npose_plugins = odometry\nmeasurement_plugins = tracker\n[odometry]\nclass = OdometryPlugin\n"
      "[tracker]\nclass = RobotPosePlugin\nreference_is_map = false\n";
  const auto [first, second] = cut(log, 0.6);
  const auto before = map(first);
  start_.start = SessionOptions::Start::pose;
  start_.start_x = 10, start_.start_y = -5, start_.start_yaw = 1;
  const auto both = goOn(*before, second);
  EXPECT_EQ(countReferences(both->view()), 1U);
  EXPECT_TRUE(both->view().map.sessions[1].aligned);
  EXPECT_LT(testing::trajectoryError(both->view(), log), testing::trajectoryError(before->view(), log) + 0.05);
  settings_ = {"tracker.reference_is_map=true"};
  EXPECT_THROW(goOn(*before, second), base::Error);
}

}  // namespace
}  // namespace omnimapper::mapper::continue_test

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/derived/SceneLandmarks.h>

#include <nlohmann/json.hpp>
#include <set>

#include "../points/PointDrive.h"
#include "dynamic/DynamicLandmarksPlugin.h"
#include "dynamic/MovedThingPayload.h"
#include "plan/GeoJson.h"

namespace omnimapper::plugins::dynamic_landmarks_plugin_test {
namespace {

using testing::SimulatedLog;

const std::string kIni = kPointsIni + R"(
[moveables]
class     = MoveableThingsPlugin
landmarks = points
)";
const std::vector<std::string> kWithMoveables = {"mapper.measurement_plugins=points, moveables"};

// A drive in which the points of `numbers` are displaced by `shift` in the second half of the log.
std::vector<mrpt::obs::CObservation::Ptr> withMovedPoints(const testing::SimulatedLogOptions& options,
                                                          const std::set<int>& numbers, const Eigen::Vector3d& shift) {
  auto after = options;
  for (const int number : numbers) after.beacons.positions[static_cast<std::size_t>(number)] += shift;
  const SimulatedLog before_log(options), after_log(after);
  const auto before = before_log.observations(), later = after_log.observations();
  const auto middle = before_log.begin() + (before_log.end() - before_log.begin()) / 2;
  std::vector<mrpt::obs::CObservation::Ptr> all;
  for (const auto& observation : before)
    if (observation->timestamp < middle) all.push_back(observation);
  for (const auto& observation : later)
    if (observation->timestamp >= middle) all.push_back(observation);
  return all;
}

testing::SimulatedLogOptions twoLaps() {
  auto options = pointDrive();
  options.laps = 2;
  return options;
}

std::vector<const MovedThingPayload*> movedThings(const mapper::View& view) {
  std::vector<const MovedThingPayload*> all;
  for (const auto& [id, landmark] : view.map.landmarks)
    if (const auto* payload = dynamic_cast<const MovedThingPayload*>(landmark.payload.get())) all.push_back(payload);
  return all;
}

TEST(DynamicLandmarksPlugin, WhereNothingMovedNothingIsFoundAndTheMapIsTheSame) {
  const SimulatedLog log(twoLaps());
  const auto with = testing::makeEngine(kIni, kWithMoveables), without = testing::makeEngine(kIni);
  testing::run(*with, log.observations());
  testing::run(*without, log.observations());
  EXPECT_TRUE(movedThings(with->view()).empty());
  EXPECT_EQ(with->view().candidates("points").size(), without->view().candidates("points").size());
  EXPECT_NEAR(testing::trajectoryError(with->view(), log), testing::trajectoryError(without->view(), log), 0.005);
}

TEST(DynamicLandmarksPlugin, OneThatMovedIsFoundWithBothItsPlaces) {
  const auto options = twoLaps();
  const Eigen::Vector3d shift(0.6, 0.3, 0);
  const auto engine = testing::makeEngine(kIni, kWithMoveables);
  testing::run(*engine, withMovedPoints(options, {3}, shift));
  const auto view = engine->view();
  const auto things = movedThings(view);
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things.front()->label, "marker 3");
  EXPECT_EQ(view.map.landmark(things.front()->landmark).state, map::Landmark::State::retired);
  for (const auto id : view.factorsOf(things.front()->landmark)) EXPECT_EQ(view.graph.factor(id).weight, 0);
  ASSERT_EQ(things.front()->places.size(), 2U);
  EXPECT_LT(things.front()->places[0].last_seen, things.front()->places[1].first_seen);
  const auto shape = things.front()->shape({}, view.map.key_frames);
  ASSERT_EQ(shape.points.size(), 2U);
  EXPECT_TRUE(shape.lines.empty()) << "the path between the places is no wall";
  EXPECT_EQ(shape.label, "marker 3");
  EXPECT_LT((shape.points[1] - shape.points[0] - shift).norm(), 0.15);
  EXPECT_LT(testing::trajectoryError(view, SimulatedLog(options)), 0.06);
  EXPECT_TRUE(std::any_of(view.decisions.begin(), view.decisions.end(),
                          [](const auto& decision) { return decision.kind == "moved thing" && decision.accepted; }));
}

TEST(DynamicLandmarksPlugin, InOutputsAMovedLandmarkIsItsPlacesAndStandsNowhere) {
  const auto engine = testing::makeEngine(kIni, kWithMoveables);
  testing::run(*engine, withMovedPoints(twoLaps(), {3}, {0.6, 0.3, 0}));
  const auto view = engine->view();
  const auto shapes = derived::shapesOf(view);
  const auto record = std::find_if(shapes.begin(), shapes.end(),
                                   [](const auto& shaped) { return shaped.landmark->kind == "moved thing"; });
  ASSERT_NE(record, shapes.end());
  EXPECT_TRUE(record->moved);
  EXPECT_EQ(derived::lengthOf(record->shape), 0) << "a length in the table is a wall's";
  EXPECT_TRUE(derived::landmarkTriangles({*record}).empty()) << "landmarks.ply has what stands";
  const auto plan = nlohmann::json::parse(plugins::encodeGeoJson({view, "test", true, false}));
  for (const auto& feature : plan["features"]) {
    const auto& properties = feature["properties"];
    const bool moved = properties["label"] == "marker 3";
    EXPECT_EQ(properties["state"], moved ? "moved" : "present") << feature;
    if (properties["kind"] != "moved thing") continue;
    EXPECT_EQ(feature["geometry"]["type"], "LineString") << feature;
    EXPECT_EQ(feature["geometry"]["coordinates"].size(), 2U);
    EXPECT_EQ(properties["times"].size(), 2U);
  }
}

TEST(DynamicLandmarksPlugin, RefusesSectionsThatNobodyHas) {
  const auto engine = testing::makeEngine(kIni, {kWithMoveables[0], "moveables.landmarks=point"});
  try {
    testing::run(*engine, SimulatedLog(pointDrive()).observations());
    FAIL() << "a misspelt section would be none";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unknown_key);
    EXPECT_NE(std::string(error.what()).find("[moveables] landmarks: 'point'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("did you mean 'points'?"), std::string::npos) << error.what();
  }
}

TEST(DynamicLandmarksPlugin, TakesTheOwnersOfAMapThatIsContinued) {
  const SimulatedLog log(pointDrive());
  const auto first = testing::makeEngine(kPointsIni);
  testing::run(*first, log.observations());
  DynamicLandmarksOptions options;
  options.landmarks = {"points"};
  mapper::PluginContext context;
  context.section = "moveables";
  context.config_text = "[moveables]\nclass = MoveableThingsPlugin\n";
  const auto view = first->view();
  EXPECT_NO_THROW(DynamicLandmarksPlugin(options, context).afterCommit(view.map.key_frames.back(), view));
}

// All points move, each to the place of another one; only odometry remains (thesis 4.6.3.4).
TEST(DynamicLandmarksPlugin, WhereAllMovedTheTrajectoryIsThatOfTheOdometry) {
  const SimulatedLog log(twoLaps());
  const auto observations = log.observations();
  const auto middle = log.begin() + (log.end() - log.begin()) / 2;
  for (const auto& observation : observations) {
    auto* seen = dynamic_cast<mrpt::obs::CObservationBearingRange*>(observation.get());
    if (!seen || seen->timestamp < middle) continue;
    for (auto& measurement : seen->sensedData) measurement.landmarkID = (measurement.landmarkID + 5) % 14;
  }
  const auto engine = testing::makeEngine(kIni, kWithMoveables), odometry = testing::makeEngine(kIni);
  testing::run(*engine, observations);
  testing::run(*odometry, changed(log, [](Measurements& measurements) { measurements.clear(); }));
  EXPECT_GE(movedThings(engine->view()).size(), 13U);
  EXPECT_LT(testing::trajectoryError(engine->view(), log), 1.1 * testing::trajectoryError(odometry->view(), log));
}

TEST(DynamicLandmarksPlugin, AFewWrongNumbersMoveNothing) {
  const SimulatedLog log(twoLaps());
  int seen = 0;
  const auto observations = changed(log, [&](Measurements& measurements) {
    for (auto& measurement : measurements)
      if (++seen % 97 == 0) measurement.range += 2;
  });
  const auto engine = testing::makeEngine(kIni, kWithMoveables);
  testing::run(*engine, observations);
  EXPECT_LE(movedThings(engine->view()).size(), 1U);
  EXPECT_LT(testing::trajectoryError(engine->view(), log), 0.06);
}

TEST(MovedThingPayload, ComesBackFromBytes) {
  map::PayloadRegistry registry;
  MovedThingPayload::addTo(registry);
  MovedThingPayload written;
  written.landmark = {1, 7};
  written.label = "marker 7";
  written.places = {{{0, 3}, {1, 2, 3}, base::stampFromUnix(10), base::stampFromUnix(20), 4},
                    {{0, 9}, {4, 5, 6}, base::stampFromUnix(30), base::stampFromUnix(40), 5}};
  std::ostringstream out;
  written.write(out);
  const auto read = registry.read("moved thing", out.str());
  const auto& back = dynamic_cast<const MovedThingPayload&>(*read);
  EXPECT_EQ(back.landmark, written.landmark);
  EXPECT_EQ(back.label, written.label);
  ASSERT_EQ(back.places.size(), 2U);
  EXPECT_EQ(back.places[1].seen_from, written.places[1].seen_from);
  EXPECT_EQ(back.places[1].point_in_base, written.places[1].point_in_base);
  EXPECT_EQ(back.places[1].last_seen, written.places[1].last_seen);
  EXPECT_EQ(back.places[1].measurements, 5U);
}

}  // namespace
}  // namespace omnimapper::plugins::dynamic_landmarks_plugin_test

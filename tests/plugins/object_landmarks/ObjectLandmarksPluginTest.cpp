#include <gtest/gtest.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/testing/HandMadeRun.h>
#include <omnimapper/testing/MapperRun.h>

#include <limits>

#include "TableWorld.h"
#include "object_landmarks/KnownObject.h"
#include "object_landmarks/ObjectPayload.h"

// Drives past a table with boxes on it, whose objects are known without errors.
namespace omnimapper::plugins::object_landmarks_plugin_test {
namespace {

using namespace table_world;

const std::string kIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = objects
solve_every         = 2
[trigger]
distance_m = 0.2
[odometry]
class = OdometryPlugin
position_noise_per_root_m = 0.003
yaw_noise_per_root_m_deg = 0.1
[objects]
class = ObjectLandmarksPlugin
)";

const Vector3d kMug(0.08, 0.08, 0.1);

TableWorld fiveThings() {
  TableWorld world;
  world.things = {onTable(0.3, 1.2, {0.2, 0.2, 0.2}), onTable(0.9, 1.3, kMug), onTable(1.15, 1.2, kMug),
                  onTable(1.7, 1.25, {0.3, 0.1, 0.15}), onTable(2.3, 1.1, {0.1, 0.1, 0.25})};
  return world;
}

struct Mapped {
  Mapped(const TableWorld& world, const Drive& drive, const std::vector<std::string>& settings = {})
      : engine(testing::makeEngine(kIni, settings)) {
    testing::run(*engine, logOf(world, drive));
  }
  std::vector<const map::Landmark*> withState(map::Landmark::State state, bool confirmed = true) const {
    std::vector<const map::Landmark*> all;
    const auto view = engine->view();
    for (const auto& [id, landmark] : view.map.landmarks)
      if (landmark.state == state && payloadOf(landmark).is_confirmed == confirmed) all.push_back(&landmark);
    return all;
  }
  std::vector<const map::Landmark*> present() const { return withState(map::Landmark::State::active); }
  std::vector<const map::Landmark*> gone() const { return withState(map::Landmark::State::retired); }
  static const ObjectPayload& payloadOf(const map::Landmark& landmark) {
    return dynamic_cast<const ObjectPayload&>(*landmark.payload);
  }
  map::Box boxOf(const map::Landmark& landmark) const {
    return payloadOf(landmark).model->box(engine->view().map.key_frames).value();
  }
  // The landmarks whose box has its middle within 5 cm of that of a thing.
  std::size_t countAt(const Thing& thing, const std::vector<const map::Landmark*>& landmarks) const {
    return static_cast<std::size_t>(std::count_if(landmarks.begin(), landmarks.end(), [&](const auto* landmark) {
      return (boxOf(*landmark).middle - thing.middle).norm() < 0.05;
    }));
  }

  std::unique_ptr<mapper::Engine> engine;
};

TEST(ObjectLandmarksPlugin, EachThingThatWasSeenIsInTheMapOnce) {
  const auto world = fiveThings();
  Drive drive;
  drive.seconds = 20;  // there and back again
  drive.rate = 2;
  const Mapped mapped(world, drive);
  const auto present = mapped.present();
  EXPECT_EQ(present.size(), world.things.size());
  for (const auto& thing : world.things) {
    ASSERT_EQ(mapped.countAt(thing, present), 1U) << thing.middle.transpose();
    for (const auto* landmark : present) {
      const auto box = mapped.boxOf(*landmark);
      if ((box.middle - thing.middle).norm() > 0.05) continue;
      Vector3d truth = thing.size, found = box.size;
      std::sort(truth.data(), truth.data() + 3);
      std::sort(found.data(), found.data() + 3);
      EXPECT_LT((truth - found).cwiseAbs().maxCoeff(), 0.04) << found.transpose();
      EXPECT_GE(Mapped::payloadOf(*landmark).evidence.seen_in, 10U);
      EXPECT_EQ(Mapped::payloadOf(*landmark).evidence.absent_in, 0U);
    }
  }
  EXPECT_TRUE(mapped.gone().empty());
}

TEST(ObjectLandmarksPlugin, WhatIsTakenAwayMeanwhileIsGoneAndTheImagesAreNamed) {
  auto world = fiveThings();
  world.things[0].until = 8;  // the robot is at the other end of the table then
  Drive drive;
  drive.seconds = 20;
  const Mapped mapped(world, drive);
  ASSERT_EQ(mapped.gone().size(), 1U);
  EXPECT_EQ(mapped.countAt(world.things[0], mapped.gone()), 1U);
  EXPECT_EQ(mapped.present().size(), 4U);
  const auto& evidence = Mapped::payloadOf(*mapped.gone().front()).evidence;
  EXPECT_GE(evidence.absent_at.size(), 3U);
  for (const auto stamp : evidence.absent_at) EXPECT_GE(stamp, at(8));
  const auto view = mapped.engine->view();
  const auto said = std::find_if(view.decisions.begin(), view.decisions.end(),
                                 [](const auto& decision) { return decision.kind == "object is gone"; });
  ASSERT_NE(said, view.decisions.end());
  EXPECT_NE(said->reason.find(base::formatUnix(evidence.absent_at.front(), 3)), std::string::npos) << said->reason;
  EXPECT_LT(base::secondsBetween(evidence.absent_at.front(), said->stamp), 3);
}

TEST(ObjectLandmarksPlugin, WhatIsGoneIsKnownToHaveStoodOnAnother) {
  TableWorld world;
  world.things = {onTable(0.3, 1.2, {0.2, 0.2, 0.2}), {{0.3, 1.2, 0.95}, kMug, 0, 8}};
  Drive drive;
  drive.seconds = 20;
  const Mapped mapped(world, drive);
  ASSERT_EQ(mapped.present().size(), 1U);
  ASSERT_EQ(mapped.gone().size(), 1U);
  EXPECT_EQ(Mapped::payloadOf(*mapped.gone().front()).on, mapped.present().front()->id);
}

TEST(ObjectLandmarksPlugin, WhatIsHiddenBySomebodyIsNeverGone) {
  auto world = fiveThings();
  Thing person{{1.4, 0.75, 0.9}, {0.6, 0.2, 1.8}, 8, 60};
  person.is_object = false;
  world.things.push_back(person);
  Drive drive;
  drive.speed = 0.1;
  drive.seconds = 80;
  drive.rate = 2;
  const Mapped mapped(world, drive);
  EXPECT_TRUE(mapped.gone().empty());
  EXPECT_EQ(mapped.present().size(), 5U);
  std::uint32_t hidden = 0;
  for (const auto* landmark : mapped.present()) hidden += Mapped::payloadOf(*landmark).evidence.hidden_in;
  EXPECT_GT(hidden, 20U);
}

TEST(ObjectLandmarksPlugin, WhatIsCarriedMakesNoLandmark) {
  auto world = fiveThings();
  for (int i = 0; i < 20; ++i) {
    Thing carried = onTable(0.2 + 0.1 * i, 0.95, kMug);
    carried.middle.z() = 1.1;
    carried.from = 0.5 * i;
    carried.until = 0.5 * (i + 1);
    world.things.push_back(carried);
  }
  Drive drive;
  drive.seconds = 20;
  const Mapped mapped(world, drive);
  EXPECT_EQ(mapped.present().size(), 5U);
}

TEST(ObjectLandmarksPlugin, ThousandsOfFragmentsAreBounded) {
  TableWorld world;
  auto log = logOf(world, Drive());
  for (auto& observation : log) {
    auto* objects = dynamic_cast<obs::CObservationObjects*>(observation.get());
    if (objects == nullptr) continue;
    for (int i = 0; i < 500; ++i) {
      ObjectPoints points;
      const double shift = base::secondsBetween(at(0), objects->timestamp);
      for (int k = 0; k < 10; ++k)
        points.emplace_back(1 + 0.01F * static_cast<float>(k), 0.3F * static_cast<float>(i % 50 - 25),
                            0.3F * static_cast<float>(i / 50) + static_cast<float>(shift));
      objects->objects.push_back(TableWorld::objectOf(std::move(points), Vector3d::UnitZ()));
    }
  }
  const auto engine = testing::makeEngine(kIni, {"objects.max_candidates=60", "objects.max_per_image=20"});
  testing::run(*engine, log);
  std::size_t active = 0;
  const auto view = engine->view();
  for (const auto& [id, landmark] : view.map.landmarks) active += landmark.state == map::Landmark::State::active;
  EXPECT_LE(active, 60U);
  EXPECT_GT(active, 20U);
}

TEST(ObjectLandmarksPlugin, ObjectsWithoutPlaceSizeOrPointsAreRefused) {
  const auto world = fiveThings();
  auto log = logOf(world, Drive());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (auto& observation : log) {
    auto* objects = dynamic_cast<obs::CObservationObjects*>(observation.get());
    if (objects == nullptr || objects->objects.empty()) continue;
    const auto good = objects->objects.front();
    const auto addBad = [&](const auto& change) {
      auto bad = good;
      change(bad);
      objects->objects.push_back(bad);
    };
    addBad([&](auto& object) { object.sensor_from_box.translation.x() = nan; });
    addBad([&](auto& object) { object.box_size.y() = 0; });
    addBad([&](auto& object) { object.points.clear(); });
    addBad([&](auto& object) { object.points.front().z() = static_cast<float>(nan); });
    addBad([&](auto& object) { object.points.front().z() = 1e9F; });
    addBad([&](auto& object) { object.covariance.setZero(); });
    addBad([&](auto& object) { object.sensor_from_box.rotation.coeffs().setZero(); });
  }
  const auto engine = testing::makeEngine(kIni);
  testing::run(*engine, log);
  std::size_t refused = 0;
  const auto view = engine->view();
  for (const auto& decision : view.decisions) refused += !decision.accepted && decision.reason.rfind("it", 0) == 0;
  EXPECT_GE(refused, 7U);
  for (const auto& [id, landmark] : view.map.landmarks)
    EXPECT_TRUE(view.graph.value(landmark.variables.front()).allFinite());
}

TEST(ObjectLandmarksPlugin, DepthsInAWrongUnitMakeNothingGone) {
  for (const float factor : {1000.F, 0.001F}) {  // millimetres as metres, metres as millimetres
    auto log = logOf(fiveThings(), {0.3, 3, 30, 2.5});
    for (auto& observation : log) {
      if (base::secondsBetween(at(10), observation->timestamp) < 0) continue;
      if (auto* scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(observation.get())) scan->rangeUnits *= factor;
      if (auto* objects = dynamic_cast<obs::CObservationObjects*>(observation.get())) objects->objects.clear();
    }
    const auto engine = testing::makeEngine(kIni);
    testing::run(*engine, log);
    const auto view = engine->view();
    std::size_t present = 0;
    for (const auto& [id, landmark] : view.map.landmarks) {
      EXPECT_NE(landmark.state, map::Landmark::State::retired) << factor;
      present += Mapped::payloadOf(landmark).is_confirmed;
      EXPECT_EQ(Mapped::payloadOf(landmark).evidence.absent_in, 0U) << factor;
    }
    EXPECT_EQ(present, 5U);
  }
}

TEST(ObjectLandmarksPlugin, WhatFillsTheViewIsBoundedAndHidesTheRest) {
  auto world = fiveThings();
  world.things.push_back({{1.5, 0.5, 1.2}, {8, 0.02, 2.4}, 8, 12});
  Drive drive;
  drive.seconds = 20;
  const Mapped mapped(world, drive);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(mapped.countAt(world.things[i], mapped.present()), 1U) << i;
  const auto view = mapped.engine->view();
  for (const auto& [id, landmark] : view.map.landmarks)
    EXPECT_LE(Mapped::payloadOf(landmark).model->size(), static_cast<std::size_t>(ModelLimits().max_points));
}

// Takes the surface and the direction up from all objects.
std::vector<CObservation::Ptr> withoutLevel(std::vector<CObservation::Ptr> log) {
  for (auto& observation : log) {
    auto* objects = dynamic_cast<obs::CObservationObjects*>(observation.get());
    if (objects == nullptr) continue;
    for (auto& object : objects->objects) {
      object.supporting_plane.reset();  // z of its box is then any direction
      object.sensor_from_box.rotation = object.sensor_from_box.rotation * Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5);
      object.box_size = Vector3d(object.box_size.y(), object.box_size.z(), object.box_size.x());
    }
  }
  return log;
}

TEST(ObjectLandmarksPlugin, WithoutALevelObjectsAreFoundAndGoneAsWell) {
  auto world = fiveThings();
  world.things[0].until = 8;
  const auto engine = testing::makeEngine(kIni);
  testing::run(*engine, withoutLevel(logOf(world, {0.3, 3, 20, 2.5})));
  std::size_t present = 0, gone = 0;
  const auto view = engine->view();
  for (const auto& [id, landmark] : view.map.landmarks) {
    if (!Mapped::payloadOf(landmark).is_confirmed) continue;
    present += landmark.state == map::Landmark::State::active;
    gone += landmark.state == map::Landmark::State::retired;
    EXPECT_EQ(Mapped::payloadOf(landmark).on, std::nullopt);
  }
  EXPECT_EQ(present, 4U);
  EXPECT_EQ(gone, 1U);
}

TEST(ObjectLandmarksPlugin, WhatStandsOnNothingStaysACandidateIfAskedFor) {
  auto world = fiveThings();
  world.things[0].until = 8;
  const auto log = logOf(world, {0.3, 3, 20, 2.5});
  for (const bool has_surface : {true, false}) {
    const auto engine = testing::makeEngine(kIni, {"objects.on_surfaces_only=true"});
    testing::run(*engine, has_surface ? log : withoutLevel(log));
    std::size_t drawn = 0;
    const auto view = engine->view();
    for (const auto& [id, landmark] : view.map.landmarks) drawn += Mapped::payloadOf(landmark).isDrawn();
    EXPECT_EQ(drawn, has_surface ? 5U : 0U);
  }
}

TEST(ObjectLandmarksPlugin, AMapIsContinuedWithItsObjects) {
  const auto world = fiveThings();
  const Mapped first(world, Drive());
  const auto before = first.present().size();
  const auto second = testing::makeEngine(kIni);
  const auto view = first.engine->view();
  second->sessions().continueFrom({view.map, view.graph}, {{0, 0, 0, 0, 0, 0}, 0.02, 0.02});
  auto log = logOf(world, Drive());
  for (auto& observation : log) observation->timestamp += base::durationFromSeconds(1000);
  testing::run(*second, log);
  std::size_t active = 0, found_again = 0;
  const auto after = second->view();
  for (const auto& [id, landmark] : after.map.landmarks) {
    if (landmark.state != map::Landmark::State::active) continue;
    if (!Mapped::payloadOf(landmark).is_confirmed) continue;
    ++active;
    found_again += Mapped::payloadOf(landmark).evidence.last_seen >= at(1000);
  }
  EXPECT_EQ(active, before) << "none is there twice";
  EXPECT_GE(found_again, 2U) << "those that were met after the session was aligned";
}

TEST(ObjectLandmarksPlugin, WhatIsNoObjectUnderTheNameOfItsSectionIsRefused) {
  testing::HandMadeRun run;
  map::Landmark landmark;
  landmark.owner = "objects";
  landmark.variables = {run.graph.addVariable(graph::point3(), Eigen::Vector3d::Zero())};
  KnownObject object;
  EXPECT_THROW(object.refresh(landmark, run.view()), base::Error);
}

TEST(ObjectLandmarksPlugin, ARunThatLocalizesChangesNoObject) {
  auto world = fiveThings();
  const Mapped first(world, Drive());
  const auto held = testing::makeEngine(kIni, {}, 1, true);
  const auto view = first.engine->view();
  held->sessions().continueFrom({view.map, view.graph}, {{0, 0, 0, 0, 0, 0}, 0.02, 0.02});
  world.things.erase(world.things.begin(), world.things.begin() + 2);
  auto log = logOf(world, Drive());
  for (auto& observation : log) observation->timestamp += base::durationFromSeconds(1000);
  testing::run(*held, log);
  const auto after = held->view();
  EXPECT_EQ(after.map.landmarks.size(), view.map.landmarks.size());
  for (const auto& [id, landmark] : after.map.landmarks)
    EXPECT_EQ(landmark.state, view.map.landmark(id).state) << toString(id);
}

}  // namespace
}  // namespace omnimapper::plugins::object_landmarks_plugin_test

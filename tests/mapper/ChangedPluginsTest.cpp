#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/live/Journal.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <fstream>

#include "run/PluginDifference.h"

// Plugins that come and go while the mapper runs (thesis 5.3.2.1). A robot drives round a room with a laser.
namespace omnimapper::mapper::changed_plugins_test {
namespace {

const std::string kWalls = R"(
[laser_lines]
class = LaserLineExtractor
[walls]
class = PlaneLandmarksPlugin
form  = wall
)";

base::Config withWalls() {
  auto config = base::Config::fromText(testing::kLaserIni + kWalls, "test.ini");
  config.set("mapper.measurement_plugins=walls, loop_closure");
  config.set("perception.extractors=laser_points, laser_lines");
  return config;
}
base::Config withoutWalls() {
  return base::Config::fromText(testing::kLaserIni + kWalls, "test.ini");
}

std::vector<mrpt::obs::CObservation::Ptr> drive() {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  return testing::SimulatedLog(options).observations();
}

std::size_t wallsOf(const Engine& engine) {
  std::size_t count = 0;
  for (const auto& [id, landmark] : engine.view().map.landmarks)
    count += landmark.owner == "walls" && landmark.state == map::Landmark::State::active;
  return count;
}

std::uint32_t evidenceOf(const Engine& engine) {
  std::uint32_t sum = 0;
  for (const auto& [id, landmark] : engine.view().map.landmarks) sum += landmark.evidence;
  return sum;
}

TEST(ChangedPlugins, whatOneMadeStaysAndOneThatReturnsGoesOnFromIt) {
  const auto log = drive();
  const auto engine = testing::makeEngine(testing::kLaserIni);
  const auto feed = [&](double from, double to) {
    const auto at = [&](double share) { return static_cast<std::size_t>(share * static_cast<double>(log.size())); };
    for (std::size_t i = at(from); i < at(to); ++i) engine->add(log[i]);
  };
  const auto change = [&](const base::Config& before, const base::Config& now) {
    auto difference = differenceOf(before, now, {}, {});
    EXPECT_FALSE(difference.isNone());
    EXPECT_EQ(engine->changePlugins(std::move(difference.change)), "");
    return difference.sentence();
  };
  feed(0, 0.25);
  EXPECT_EQ(wallsOf(*engine), 0u);
  EXPECT_EQ(change(withoutWalls(), withWalls()), "added laser_lines, walls");
  feed(0.25, 0.5);
  const auto walls = wallsOf(*engine);
  EXPECT_GE(walls, 3u);
  EXPECT_EQ(change(withWalls(), withoutWalls()), "removed laser_lines, walls");
  const auto evidence = evidenceOf(*engine);
  feed(0.5, 0.75);
  EXPECT_EQ(wallsOf(*engine), walls) << "they stay";
  EXPECT_EQ(evidenceOf(*engine), evidence) << "and nobody measures them";
  change(withoutWalls(), withWalls());
  feed(0.75, 1);
  engine->finish();
  EXPECT_LE(wallsOf(*engine), walls + 2) << "the walls of before are measured again";
  EXPECT_GT(evidenceOf(*engine), evidence + 10);
  ASSERT_EQ(engine->plugins().measurement.size(), 3u);
  EXPECT_EQ(engine->plugins().measurement[1].section, "walls") << "in the order of the INI, after the level";
}

TEST(ChangedPlugins, theResultDependsOnlyOnWhatCameBefore) {
  const auto log = drive();
  const auto bits = [&](int threads) {
    const auto engine = testing::makeEngine(testing::kLaserIni, {}, threads);
    for (std::size_t i = 0; i < log.size(); ++i) {
      if (i == log.size() / 3) engine->changePlugins(differenceOf(withoutWalls(), withWalls(), {}, {}).change);
      if (i == 2 * log.size() / 3) engine->changePlugins(differenceOf(withWalls(), withoutWalls(), {}, {}).change);
      engine->add(log[i]);
    }
    engine->finish();
    return testing::bitsOf(engine->view());
  };
  EXPECT_TRUE(bits(1) == bits(4));
}

TEST(ChangedPlugins, otherSettingsMakeAPluginAnewAndTheRestIsNamed) {
  loadFeatures();
  auto now = withWalls();
  now.set("walls.line_sigma_m=0.05");
  now.set("trigger.distance_m=0.1");
  const auto difference = differenceOf(withWalls(), now, {}, {});
  EXPECT_EQ(difference.sentence(), "gave other settings to walls");
  ASSERT_EQ(difference.change.added.measurement.size(), 1u);
  EXPECT_EQ(difference.change.removed, std::vector<std::string>{"walls"});
  ASSERT_EQ(difference.unused.size(), 1u);
  EXPECT_NE(difference.unused[0].find("[trigger] distance_m"), std::string::npos);
  EXPECT_TRUE(differenceOf(now, now, {}, {}).isNone());
}

// View links take the options of the camera's matching from the section of its odometry.
TEST(ChangedPlugins, aPluginThatReadsAChangedSectionIsMadeAnewToo) {
  loadFeatures();
  const auto withDepth = [](const std::string& use_depth) {
    return base::Config::fromText(R"(
[mapper]
pose_plugins = camera
measurement_plugins = links
[camera]
class = VisualOdometryPlugin
use_depth = )" + use_depth + R"(
[links]
class = ViewLinksPlugin
odometry = camera
)",
                                  "test.ini");
  };
  const auto difference = differenceOf(withDepth("true"), withDepth("false"), {}, {});
  EXPECT_EQ(difference.sentence(), "gave other settings to camera, links");
  EXPECT_EQ(difference.change.removed, (std::vector<std::string>{"camera", "links"}));
}

TEST(ChangedPlugins, theLastPosePluginCannotGo) {
  const auto engine = testing::makeEngine(testing::kLaserIni);
  PluginChange change;
  change.removed = {"scan_odometry", "odometry", "no_motion"};
  for (const auto& observation : drive()) {
    engine->add(observation);
    if (engine->view().map.key_frames.size() > 2) break;
  }
  EXPECT_NE(engine->changePlugins(std::move(change)).find("pose plugin"), std::string::npos);
  EXPECT_EQ(engine->plugins().pose.size(), 3u);
  auto wrong = withWalls();
  wrong.set("mapper.measurement_plugins=nobody");
  EXPECT_THROW(differenceOf(withWalls(), wrong, {}, {}), base::Error);
}

// The new settings do not fit what the plugin made: it stays, with all that it knows.
TEST(ChangedPlugins, whatDoesNotFitTheMapChangesNothing) {
  const auto log = drive();
  auto config = withWalls();
  const auto engine = testing::makeEngine(config.text());
  for (std::size_t i = 0; i < log.size() / 2; ++i) engine->add(log[i]);
  ASSERT_GE(wallsOf(*engine), 3u);
  auto other = withWalls();
  other.set("walls.form=plane");
  const auto evidence = evidenceOf(*engine);
  EXPECT_NE(engine->changePlugins(differenceOf(config, other, {}, {}).change).find("[walls]"), std::string::npos);
  EXPECT_EQ(engine->plugins().measurement.size(), 3u);
  for (std::size_t i = log.size() / 2; i < log.size(); ++i) engine->add(log[i]);
  engine->finish();
  EXPECT_GT(evidenceOf(*engine), evidence);
}

// Perception of a bundle that does not become part of the map still runs when the bundle has been processed.
TEST(ChangedPlugins, perceptionIsFinishedBeforeItsPluginsGo) {
  const auto log = drive();
  const auto engine = testing::makeEngine(testing::kLaserIni, {"mapper.pose_plugins=odometry"}, 4);
  for (std::size_t i = 0; i < log.size() / 4; ++i) {
    if (dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(log[i].get())) engine->add(log[i]);
    if (i % 20 != 0) continue;
    engine->changePlugins(
        differenceOf(i % 40 == 0 ? withoutWalls() : withWalls(), i % 40 == 0 ? withWalls() : withoutWalls(), {}, {})
            .change);
  }
  engine->finish();
  EXPECT_LE(engine->view().map.key_frames.size(), 1u) << "nothing measured the motion";
}

TEST(ChangedPlugins, anotherOrderIsAChange) {
  loadFeatures();
  auto now = withWalls();
  now.set("mapper.measurement_plugins=loop_closure, walls");
  EXPECT_EQ(differenceOf(withWalls(), now, {}, {}).sentence(), "changed the order");
}

// A journal says where the plugins of a live run were changed; their INIs are beside it.
TEST(ChangedPlugins, aReplayChangesThemAtTheSamePlace) {
  const auto log = drive();
  const testing::ScratchFolder folder;
  const std::string journal = folder / "live.journal";
  source::writeRawlog(folder / "live.rawlog", [&](source::RawlogWriter& out) {
    for (const auto& one : log) out.add(*one);
  });
  const std::size_t middle = log.size() / 2;
  {
    live::JournalWriter writer(journal);
    for (std::size_t i = 0; i < log.size(); ++i) {
      if (i == middle) writer.add({live::JournalEvent::Kind::plugins, 1});
      writer.add({live::JournalEvent::Kind::add, i});
    }
  }
  const auto replayed = [&](const std::string& name, const std::vector<std::string>& settings = {}) {
    RunRequest request;
    request.replay = journal;
    request.output_folder = folder / name;
    auto config = withoutWalls();
    for (const auto& setting : settings) config.set(setting);
    base::Progress silent;
    return runMapping(request, config, silent, [] { return false; });
  };
  loadFeatures();
  EXPECT_THROW(replayed("missing"), base::Error) << "the INI of the change is not there";
  std::ofstream(live::iniOf(journal, 1)) << withWalls().text() << "\n[tirgger]\ndistance_m = 0.1\n";
  EXPECT_THROW(replayed("misspelt"), base::Error) << "nobody reads one of its sections";
  std::ofstream(live::iniOf(journal, 1)) << base::kWrittenFromALog << ".\n" << withWalls().text();
  const auto result = replayed("with");
  ASSERT_EQ(result.landmarks.count("wall"), 1u);
  EXPECT_GE(result.landmarks.at("wall"), 3u);
  std::ofstream(live::iniOf(journal)) << base::kWrittenFromALog << ".\n" << withoutWalls().text();
  const auto other = replayed("other", {"trigger.distance_m=0.1"});
  EXPECT_EQ(other.landmarks.count("wall"), 0u);
  EXPECT_TRUE(std::any_of(other.warnings.begin(), other.warnings.end(), [](const std::string& warning) {
    return warning.find("change 1 of the plugins") != std::string::npos;
  }));
}

}  // namespace
}  // namespace omnimapper::mapper::changed_plugins_test

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/SessionMetrics.h>
#include <omnimapper/testing/Fixtures.h>

#include <iterator>
#include <ostream>

// The sections of a map file other than the frames of a single session.
namespace omnimapper::map::sections_test {
namespace {

class Sign : public LandmarkPayload {
 public:
  explicit Sign(std::string text) : text(std::move(text)) {}
  std::string_view kind() const override { return "sign"; }
  void write(std::ostream& out) const override { out << text; }
  const std::string text;
};

PayloadRegistry withSigns() {
  PayloadRegistry registry;
  registry.add("sign", [](std::istream& in) {
    return std::make_shared<Sign>(std::string(std::istreambuf_iterator<char>(in), {}));
  });
  return registry;
}

Landmark landmark(base::LandmarkId id, const std::string& kind) {
  Landmark result;
  result.id = id;
  result.kind = kind;
  result.owner = "owner of " + kind;
  return result;
}

Map mapWithLandmarks() {
  Map map;
  auto sign = landmark({0, 0}, "door sign");
  sign.variables = {{0, 7}, {1, 2}};
  sign.payload = std::make_shared<Sign>(std::string("Room \0 12", 9));
  sign.evidence = 41;
  sign.first_seen = base::stampFromUnix(1.1e9);
  sign.last_seen = base::stampFromUnix(1.2e9 + 1e-7);
  map.landmarks.add(0, sign);
  map.landmarks.skip(0);  // an id that is not used any more
  auto merged = landmark({0, 2}, "door sign");
  merged.state = Landmark::State::merged;
  merged.merged_into = {0, 0};
  map.landmarks.add(0, merged);
  auto wall = landmark({3, 0}, "wall");
  wall.state = Landmark::State::retired;
  map.landmarks.add(3, wall);
  map.landmarks.skip(3);
  return map;
}

TEST(LandmarksSection, KeepsEveryFieldAndWhichIdsWereGiven) {
  const auto loaded = landmarksFromSection(landmarksToSection(mapWithLandmarks()), withSigns());
  ASSERT_EQ(loaded.size(), 3U);
  const Landmark* sign = loaded.find({0, 0});
  ASSERT_TRUE(sign);
  EXPECT_EQ(sign->id, (base::LandmarkId{0, 0}));
  EXPECT_EQ(sign->kind, "door sign");
  EXPECT_EQ(sign->owner, "owner of door sign");
  EXPECT_EQ(sign->variables, (std::vector<base::VariableId>{{0, 7}, {1, 2}}));
  EXPECT_EQ(sign->evidence, 41U);
  EXPECT_EQ(sign->first_seen, base::stampFromUnix(1.1e9));
  EXPECT_EQ(sign->last_seen, base::stampFromUnix(1.2e9 + 1e-7));
  EXPECT_EQ(sign->state, Landmark::State::active);
  const auto payload = std::dynamic_pointer_cast<const Sign>(sign->payload);
  ASSERT_TRUE(payload);
  EXPECT_EQ(payload->text, std::string("Room \0 12", 9));
  EXPECT_EQ(loaded.find({0, 1}), nullptr);
  EXPECT_EQ(loaded.find({0, 2})->state, Landmark::State::merged);
  EXPECT_EQ(loaded.find({0, 2})->merged_into, (base::LandmarkId{0, 0}));
  EXPECT_EQ(loaded.find({3, 0})->payload, nullptr);
  EXPECT_EQ(loaded.nextId(0).index, 3U);
  EXPECT_EQ(loaded.nextId(3).index, 2U) << "an id is never given twice";
}

TEST(LandmarksSection, AnUnknownPayloadKeepsItsBytesOverTwoRoundTrips) {
  const auto first = landmarksToSection(mapWithLandmarks());
  Map map;
  map.landmarks = landmarksFromSection(first, PayloadRegistry());
  const auto second = landmarksToSection(map);
  map.landmarks = landmarksFromSection(second, PayloadRegistry());
  const auto third = landmarksToSection(map);
  EXPECT_EQ(first.bytes, second.bytes);
  EXPECT_EQ(second.bytes, third.bytes);
  EXPECT_EQ(landmarksFromSection(third, withSigns()).find({0, 0})->payload->kind(), "sign");
}

TEST(LandmarksSection, APayloadThatItsReaderLeavesBytesOfIsRefused) {
  PayloadRegistry greedy_for_one;
  greedy_for_one.add("sign", [](std::istream& in) {
    in.get();
    return std::make_shared<Sign>("");
  });
  EXPECT_THROW(landmarksFromSection(landmarksToSection(mapWithLandmarks()), greedy_for_one), base::Error);
}

TEST(LandmarksSection, CutsLaterVersionsAndOtherSectionsAreRefused) {
  auto section = landmarksToSection(mapWithLandmarks());
  for (std::size_t length = 0; length < section.bytes.size(); ++length) {
    EXPECT_THROW(landmarksFromSection({"landmarks", 1, section.bytes.substr(0, length)}, {}), base::Error) << length;
  }
  EXPECT_THROW(landmarksFromSection({"landmarks", 1, section.bytes + "x"}, {}), base::Error);
  EXPECT_THROW(landmarksFromSection({"landmarks", 2, section.bytes}, {}), base::Error);
  EXPECT_THROW(landmarksFromSection({"sessions", 1, section.bytes}, {}), base::Error);
}

// A million unused ids in each of all sessions would take 16 GB and half an hour.
TEST(LandmarksSection, SessionsThatSayTheyGaveTooManyIdsTogetherAreRefused) {
  const auto sessions = [](int count, std::uint32_t ids) {
    std::string bytes;
    const auto add = [&](std::uint32_t value, int size) {
      for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
    };
    add(static_cast<std::uint32_t>(count), 4);
    for (int session = 0; session < count; ++session) {
      add(static_cast<std::uint32_t>(session), 2);
      add(ids, 4);
    }
    add(0, 4);  // landmarks
    return MapSection{"landmarks", 1, bytes};
  };
  EXPECT_EQ(landmarksFromSection(sessions(2, 400'000), {}).nextId(1).index, 400'000U);
  EXPECT_THROW(landmarksFromSection(sessions(65'535, 1'000'000), {}), base::Error);
}

TEST(SessionsSection, KeepsEveryField) {
  Map map;
  map.sessions.push_back({0, "monday", {0, 0}, true});
  map.sessions.push_back({2, "tuesday", {2, 5}, true, base::KeyFrameId{2, 9}});
  map.sessions.push_back({3, "", {3, 1}, false});
  const auto section = sessionsToSection(map);
  const auto loaded = sessionsFromSection(section);
  ASSERT_EQ(loaded.size(), 3U);
  EXPECT_EQ(loaded[0].title, "monday");
  EXPECT_FALSE(loaded[0].aligned_at);
  EXPECT_EQ(loaded[1].number, 2);
  EXPECT_EQ(loaded[1].anchor, (base::VariableId{2, 5}));
  EXPECT_EQ(loaded[1].aligned_at, (base::KeyFrameId{2, 9}));
  EXPECT_FALSE(loaded[2].aligned);
  for (std::size_t length = 0; length < section.bytes.size(); ++length) {
    EXPECT_THROW(sessionsFromSection({"sessions", 1, section.bytes.substr(0, length)}), base::Error) << length;
  }
  EXPECT_THROW(sessionsFromSection({"sessions", 2, section.bytes}), base::Error);
}

TEST(SessionsSection, SessionsOutOfOrderAreRefused) {
  Map map;
  map.sessions.push_back({1, "a", {}, true});
  map.sessions.push_back({1, "b", {}, true});
  EXPECT_THROW(sessionsFromSection(sessionsToSection(map)), base::Error);
}

TEST(FramesSection, KeepsWhatTheReferenceSensorSaw) {
  Map map;
  for (std::uint32_t i = 0; i < 2; ++i) {
    KeyFrame frame;
    frame.id = {0, i};
    frame.stamp = base::stampFromUnix(1e9 + i);
    frame.reference = i == 1;
    map.key_frames.insert(frame);
  }
  const auto loaded = framesFromSection(framesToSection(map));
  EXPECT_FALSE(loaded.key_frames[0].reference);
  EXPECT_TRUE(loaded.key_frames[1].reference);
}

// 3 m and 4 m, then 1 m of a session that was driven before them.
TEST(SessionMetrics, AreOfEachSessionAndNotOfTheLeapBetween) {
  Map map;
  const auto add = [&](base::KeyFrameId id, double seconds, double x) {
    KeyFrame frame;
    frame.id = id;
    frame.stamp = base::stampFromUnix(1e9 + seconds);
    frame.map_from_base = mrpt::poses::CPose3D(x, 0, 0, 0, 0, 0);
    map.key_frames.insert(frame);
  };
  add({0, 0}, 100, 0);
  add({0, 1}, 110, 3);
  add({0, 2}, 130, -1);
  add({1, 0}, 50, 1000);
  add({1, 1}, 55, 1001);
  map.key_frames.edit({1, 1}).dependents.push_back({base::stampFromUnix(1e9 + 57), {}});
  const auto metrics = sessionMetrics(map);
  ASSERT_EQ(metrics.size(), 2U);
  EXPECT_EQ(metrics[0].key_frames, 3U);
  EXPECT_DOUBLE_EQ(metrics[0].travel, 7);
  EXPECT_DOUBLE_EQ(metrics[0].seconds, 30);
  EXPECT_EQ(metrics[1].number, 1);
  EXPECT_DOUBLE_EQ(metrics[1].travel, 1);
  EXPECT_DOUBLE_EQ(metrics[1].seconds, 7);
  const auto trajectory = denseTrajectory(map);
  ASSERT_EQ(trajectory.size(), 6U);
  EXPECT_EQ(trajectory[2].session, 0);
  EXPECT_EQ(trajectory[3].session, 1);
  EXPECT_EQ(trajectory[5].session, 1);
}

TEST(LevelSection, HoldsWhichWayIsUpAndRefusesWhatIsNoDirection) {
  Level level;
  level.source = Level::Source::imu;
  level.up = {0, 0.6, 0.8};
  level.covariance.diagonal() = Eigen::Vector3d(1e-4, 2e-4, 0);
  level.reason = "gravity";
  const Level read = Level::fromSection(layerToSection("level", LayerOf<Level>(level)));
  EXPECT_EQ(read.source, level.source);
  EXPECT_EQ(read.up, level.up);
  EXPECT_EQ(read.covariance, level.covariance);
  EXPECT_EQ(read.reason, level.reason);
  level.up = {0, 0, 2};
  EXPECT_THROW(Level::fromSection(layerToSection("level", LayerOf<Level>(level))), base::Error);
  auto damaged = layerToSection("level", LayerOf<Level>(read));
  damaged.bytes[0] = 9;
  EXPECT_THROW(Level::fromSection(damaged), base::Error);
  damaged.bytes.resize(20);
  EXPECT_THROW(Level::fromSection(damaged), base::Error);
}

TEST(Level, TurnsUpToZAndSaysSo) {
  Level level;
  EXPECT_EQ(level.levelFromMap().coeffs(), Eigen::Quaterniond::Identity().coeffs()) << "up is unknown";
  EXPECT_EQ(sentenceOf(level), "which way is up is not known: ");
  level.source = Level::Source::planes;
  level.up = {0, -1, 0};
  level.covariance.diagonal() = Eigen::Vector3d(0.0001, 0, 0.0004);
  level.reason = "all of them";
  EXPECT_LT((level.levelFromMap() * level.up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(level.standardDeviation(), 0.02, 1e-12);
  EXPECT_EQ(sentenceOf(level), "up is (0.000, -1.000, 0.000) of the map +- 1.15 deg, by planes: all of them");
  level.up = {0, 0, -1};
  EXPECT_LT((level.levelFromMap() * level.up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

}  // namespace
}  // namespace omnimapper::map::sections_test

#include <gtest/gtest.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/testing/Fixtures.h>

#include <set>
#include <string>

#include "BeaconDrive.h"

// Sessions are numbered by the map that they continue, or by [session] number.
namespace omnimapper::mapper::session_number_test {
namespace {

constexpr int kLargest = 65533;

std::unique_ptr<Engine> mapped(const std::string& number, std::uint64_t seed) {
  auto options = beacons::drive();
  options.seed = seed;
  options.laps = 0.3;
  auto engine = testing::makeEngine(
      beacons::kBeaconIni, number.empty() ? std::vector<std::string>{} : std::vector{"session.number=" + number});
  testing::run(*engine, testing::SimulatedLog(options).observations());
  return engine;
}

// The ids of everything in a map, by their texts and kinds.
std::set<std::string> idsOf(const View& view) {
  std::set<std::string> ids;
  for (const auto& frame : view.map.key_frames) ids.insert("key frame " + toString(frame.id));
  for (const auto& [id, landmark] : view.map.landmarks) ids.insert("landmark " + toString(id));
  for (const auto& [id, record] : view.graph.variables()) ids.insert("variable " + toString(id));
  for (const auto& [id, record] : view.graph.factors()) ids.insert("factor " + toString(id));
  return ids;
}

map::Map mapWithSessions(const std::vector<std::uint16_t>& numbers) {
  map::Map map;
  for (const auto number : numbers) map.sessions.push_back({number, "", {}, true});
  return map;
}

SessionOptions numbered(int number) {
  SessionOptions options;
  options.number = number;
  return options;
}

std::string errorOf(const SessionOptions& options, const map::Map& map) {
  try {
    options.numberIn(map);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(SessionNumber, WithoutOneItIsTheNextOfTheMap) {
  EXPECT_EQ(SessionOptions().numberIn(mapWithSessions({})), 0);
  EXPECT_EQ(SessionOptions().numberIn(mapWithSessions({0})), 1);
  EXPECT_EQ(SessionOptions().numberIn(mapWithSessions({0, 1, 7})), 8);
}

TEST(SessionNumber, OneThatIsLargerThanThoseOfTheMapIsTaken) {
  EXPECT_EQ(numbered(5).numberIn(mapWithSessions({})), 5);
  EXPECT_EQ(numbered(5).numberIn(mapWithSessions({0, 4})), 5);
  EXPECT_EQ(numbered(kLargest).numberIn(mapWithSessions({0})), kLargest);
}

TEST(SessionNumber, OneThatIsTakenOrEarlierIsAnErrorWithTheRemedy) {
  for (const int number : {0, 1, 3}) {
    const std::string error = errorOf(numbered(number), mapWithSessions({0, 3}));
    EXPECT_NE(error.find("[session] number = " + std::to_string(number)), std::string::npos) << error;
    EXPECT_NE(error.find("session.number=4"), std::string::npos) << error;
  }
}

TEST(SessionNumber, AMapWithTheLargestNumberCannotBeContinued) {
  EXPECT_NE(errorOf({}, mapWithSessions({kLargest})).find("largest"), std::string::npos);
}

TEST(SessionNumber, HasBounds) {
  const auto read = [](const std::string& number) {
    const auto config = base::Config::fromText("[session]\nnumber = " + number + "\n", "test.ini");
    return config.section("session").read<SessionOptions>().number;
  };
  EXPECT_EQ(read("65533"), kLargest);
  EXPECT_EQ(read("0"), 0);
  for (const char* number : {"-1", "65534", "1.5", "first"}) EXPECT_THROW(read(number), base::Error) << number;
}

TEST(SessionNumber, TwoLogsThatAreMappedApartHaveNoIdInCommon) {
  const auto first = mapped("1", 1), second = mapped("2", 2);
  const auto ids = idsOf(first->view()), others = idsOf(second->view());
  ASSERT_GT(first->view().map.landmarks.size(), 0U);
  ASSERT_GT(second->view().map.landmarks.size(), 0U);
  for (const auto& id : others) EXPECT_EQ(ids.count(id), 0U) << id;
  const auto unnumbered = idsOf(mapped("", 1)->view());
  EXPECT_EQ(unnumbered.size(), ids.size());
  EXPECT_EQ(unnumbered.count("key frame 0:0"), 1U);
  EXPECT_EQ(ids.count("key frame 1:0"), 1U);
}

TEST(SessionNumber, TheNumberChangesTheMapInNothingElse) {
  const auto plain = mapped("", 1), numbered = mapped("9", 1);
  const auto &a = plain->view().map.key_frames, &b = numbered->view().map.key_frames;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(b[i].id, (base::KeyFrameId{9, a[i].id.index}));
    EXPECT_EQ(a[i].map_from_base, b[i].map_from_base);
  }
}

TEST(SessionNumber, AMapIsSavedAndContinuedWithIt) {
  const testing::ScratchFolder folder;
  const std::string path = folder / "map.omnimap";
  derived::mapFileToAsk(mapped("4", 1)->view()).write(path);
  const auto again = testing::makeEngine(beacons::kBeaconIni, {"session.number=6"});
  auto saved = derived::readMap(path, registeredKinds());
  again->sessions().continueFrom(std::move(saved), {{0, 0, 0, 0, 0, 0}, 1, 0.5});
  auto options = beacons::drive();
  options.seed = 2;
  options.laps = 0.3;
  testing::run(*again, testing::SimulatedLog(options).observations());
  const auto view = again->view();
  ASSERT_EQ(view.map.sessions.size(), 2U);
  EXPECT_EQ(view.map.sessions[0].number, 4);
  EXPECT_EQ(view.map.sessions[1].number, 6);
  EXPECT_TRUE(view.map.sessions[1].aligned);
  EXPECT_EQ(view.map.key_frames.back().id.session, 6);
  EXPECT_THROW(testing::makeEngine(beacons::kBeaconIni, {"session.number=4"})
                   ->sessions()
                   .continueFrom(derived::readMap(path, registeredKinds()), {{0, 0, 0, 0, 0, 0}, 1, 0.5}),
               base::Error);
}

TEST(SessionNumber, ASessionThatIsOnlyLocalizedNeedsNone) {
  const auto map = mapped("4", 1);
  const auto engine = testing::makeEngine(beacons::kBeaconIni, {"session.number=4"}, 1, true);
  engine->sessions().localizeIn({map->view().map, map->view().graph}, {{0, 0, 0, 0, 0, 0}, 0.1, 0.1}, 20);
  EXPECT_EQ(engine->view().map.sessions.back().number, 5);
}

}  // namespace
}  // namespace omnimapper::mapper::session_number_test

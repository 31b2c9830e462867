// omnimapper-query on a map of an office with door signs, asked by a person and by a robot.
#include <omnimapper/map/Places.h>
#include <omnimapper/query/MapGrid.h>

#include <algorithm>
#include <memory>

#include "../MapFolder.h"
#include "SignedOffice.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sourceFile;

constexpr int kNothingFound = 20;

class Query : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchFolder>();
    ASSERT_TRUE(endedWith(ExitCode::ok, omnimapper::testing::runProgram(
                                            {omnimapper::testing::ownProgram("omnimapper-simulate"), "-q", "-i",
                                             sourceFile("rawlogs/signs_office.ini"), "-o", office(), "--set",
                                             "simulation.sensors=laser,odometry", "--set", "simulation.duration_s=115",
                                             "--set", "robot.max_speed_m_s=1", "--set", "laser.rate_hz=4"})));
    writeObservedSigns(office());
    ASSERT_TRUE(endedWith(
        ExitCode::ok,
        graphslam({"-q", "-i", sourceFile("ini/signs.ini"), "--set", "perception.extractors=laser_points,laser_lines",
                   "--set", "mapper.output_plugins=trajectory,grid,map", "-r", office() + "/signs_office.rawlog", "-r",
                   office() + "/signs.rawlog", "-o", map()})));
    signs_ = trueSigns(office());
    world_from_map_ = worldFromMap(office(), map());
  }
  static void TearDownTestSuite() { scratch_.reset(); }
  static std::string office() { return *scratch_ / "office"; }
  static std::string map() { return *scratch_ / "map"; }

  static Ended ask(const Texts& words, const std::string& of = map()) {
    Texts command{omnimapper::testing::ownProgram("omnimapper-query"), of};
    command.insert(command.end(), words.begin(), words.end());
    return omnimapper::testing::runProgram(command);
  }
  /// The answer as JSON; null if the query fails.
  static json answer(Texts words) {
    words.emplace_back("--json");
    const auto ended = ask(words);
    EXPECT_EQ(ended.code, 0) << toString(ended);
    return ended.code == 0 ? json::parse(ended.out) : json();
  }
  static Vector3d inWorld(const json& position) {
    return world_from_map_ * Vector3d(position[0], position[1], position[2]);
  }
  /// Distance [m] of the object that was found from the nearest true sign with that line.
  static double offFrom(const std::string& line, const json& found) {
    double least = 1e9;
    for (const auto& sign : signs_)
      if (sign.has(line)) least = std::min(least, (sign.position - inWorld(found["position_m"])).norm());
    return least;
  }
  static const TrueSign& signOf(const std::string& line) {
    return *std::find_if(signs_.begin(), signs_.end(), [&](const auto& sign) { return sign.has(line); });
  }
  static Vector3d inMap(const Vector3d& in_world) { return omnimapper::geometry::inverse(world_from_map_) * in_world; }

  static std::unique_ptr<ScratchFolder> scratch_;
  static std::vector<TrueSign> signs_;
  static Se3 world_from_map_;
};
std::unique_ptr<ScratchFolder> Query::scratch_;
std::vector<TrueSign> Query::signs_;
Se3 Query::world_from_map_;

TEST_F(Query, TheTextOfASignFindsItsPosition) {
  for (const char* number : {"118", "120", "124", "131", "132", "141", "143", "145", "147", "149", "151"}) {
    const auto found = answer({number});
    ASSERT_EQ(found["matches"].size(), 1U) << number;
    EXPECT_EQ(found["matches"][0]["match"], "exact");
    EXPECT_LT(offFrom(number, found["matches"][0]), 0.5) << number;
    const auto sigma = found["matches"][0]["sigma_m"];
    EXPECT_TRUE(sigma.is_number() && sigma > 0 && sigma < 1) << number << ": " << sigma;
    EXPECT_TRUE(found["matches"][0]["seen_by"].contains("camera")) << found;
  }
  for (const char* words : {"Kitchen", "Lucy Marsh", "Ned Alvarez", "Copy Room"}) {
    const auto found = answer({"find", words});
    ASSERT_EQ(found["matches"].size(), 1U) << words;
    EXPECT_EQ(found["matches"][0]["match"], "same letters");
    EXPECT_LT(offFrom(words, found["matches"][0]), 0.5) << words;
  }
}

TEST_F(Query, ATextThatStandsOnSeveralSignsListsThemAll) {
  for (const char* word : {"Storage", "Women", "Mina Sato"}) {
    const auto found = answer({word});
    EXPECT_EQ(found["matches"].size(), 2U) << word;
    for (const auto& match : found["matches"]) EXPECT_LT(offFrom(word, match), 0.5) << word;
  }
  EXPECT_NE(ask({"Women"}).out.find("2 landmarks, all listed"), std::string::npos);
}

TEST_F(Query, AGoalIsFreeAndInFrontOfTheSign) {
  const auto grid = omnimapper::query::readGrid(map());
  for (const char* number : {"118", "124", "131", "132", "141", "145", "147"}) {
    const auto goal = answer({"goal", number})["goal"];
    const Vector3d at(goal["x_m"], goal["y_m"], 0);
    EXPECT_TRUE(goal["connected"]) << number;
    for (int turn = 0; turn < 16; ++turn) {
      const Eigen::Vector2d rim =
          at.head<2>() + 0.24 * Eigen::Vector2d(std::cos(turn * 0.3927), std::sin(turn * 0.3927));
      EXPECT_EQ(grid.at(grid.cellOf(rim)), omnimapper::query::GridCell::free) << number;
    }
    const TrueSign& sign = signOf(number);
    const Vector3d to_goal = world_from_map_ * at - sign.position, level(to_goal.x(), to_goal.y(), 0);
    EXPECT_NEAR(level.norm(), 1, 0.5) << number;
    EXPECT_GT(level.normalized().dot(sign.normal), 0.45) << number << ": the sign must be readable from there";
    const Vector3d to_sign = inMap(sign.position) - at;
    const double off = std::remainder(std::atan2(to_sign.y(), to_sign.x()) - goal["yaw_rad"].get<double>(), 2 * M_PI);
    EXPECT_LT(std::abs(off), 0.5) << number << ": the goal must face the sign";
  }
}

TEST_F(Query, OfSignsThatAreAlikeTheNearestToTheStartIsTheGoal) {
  for (const auto& sign : signs_) {
    if (!sign.has("Storage")) continue;
    const Vector3d before = inMap(sign.position + sign.normal);
    const auto ended = ask({"goal", "storage", "--from", std::to_string(before.x()), std::to_string(before.y())});
    EXPECT_NE(ended.out.find("of 2 matches the one nearest to the start"), std::string::npos) << toString(ended);
    const auto goal =
        answer({"goal", "storage", "--from", std::to_string(before.x()), std::to_string(before.y())})["goal"];
    EXPECT_LT((Vector3d(goal["x_m"], goal["y_m"], 0) - Vector3d(before.x(), before.y(), 0)).norm(), 1);
  }
}

TEST_F(Query, NearAPointIsWhatIsThere) {
  for (const char* number : {"120", "141", "143", "151"}) {
    const Vector3d before = inMap(signOf(number).position + 0.3 * signOf(number).normal);
    const auto near = answer({"near", std::to_string(before.x()), std::to_string(before.y()), "--within", "1"});
    const auto& places = near["places"];
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const json& place) {
      return place["caption"] == number;
    })) << number;
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const json& place) { return place["label"] == "wall"; }))
        << number;
  }
}

TEST_F(Query, ListsAreByKind) {
  const auto kinds = answer({"list"})["kinds"];
  EXPECT_GE(kinds["sign"], 20);
  EXPECT_GE(kinds["wall"], 4);
  const auto signs = answer({"list", "signs"})["places"];
  EXPECT_EQ(signs.size(), kinds["sign"]);
  for (std::size_t i = 1; i < signs.size(); ++i)
    if (signs[i]["properties"].contains("number") && signs[i - 1]["properties"].contains("number")) {
      EXPECT_LE(std::stoi(signs[i - 1]["caption"].get<std::string>()),
                std::stoi(signs[i]["caption"].get<std::string>()));
    }
}

TEST_F(Query, WrongWordsGetTheNearestRightOnes) {
  for (const auto& [wrong, right] : std::vector<std::pair<std::string, std::string>>{{"kithcen", "KITCHEN"},
                                                                                     {"Strage", "STORAGE"},
                                                                                     {"lusy marsh", "LUCY MARSH"},
                                                                                     {"l18", "118"},
                                                                                     {"I2O", "120"},
                                                                                     {"Womn", "WOMEN"},
                                                                                     {"okafro", "TOM OKAFOR"},
                                                                                     {"meetnig room", "MEETING ROOM"},
                                                                                     {"13l", "131"},
                                                                                     {"sgin", "sign"}}) {
    const auto ended = ask({wrong});
    EXPECT_EQ(ended.code, 0) << toString(ended);
    EXPECT_EQ(ended.out.rfind("nothing is called '" + wrong + "'; nearest: '" + right, 0), 0U) << ended.out;
  }
  const auto none = ask({"777"});
  EXPECT_EQ(none.code, kNothingFound);
  EXPECT_NE(none.err.find("nothing is called '777' or similarly; omnimapper-query MAP list shows what there is"),
            std::string::npos);
}

TEST_F(Query, WhatCannotBeAskedIsAnErrorThatSaysWhy) {
  const auto refuses = [](const Texts& words, ExitCode code, const std::string& why) {
    const auto ended = ask(words);
    EXPECT_TRUE(endedWith(code, ended, {why}));
    EXPECT_EQ(ended.err.find('\x1b'), std::string::npos);
    EXPECT_LT(ended.err.size(), 600U) << ended.err;
  };
  refuses({}, ExitCode::command_line, "after MAP, find needs TEXT");
  refuses({""}, ExitCode::command_line, "empty");
  refuses({"a\x1b[31m"}, ExitCode::command_line, "\\x1b");
  refuses({"\xff\xfe"}, ExitCode::command_line, "UTF-8");
  refuses({std::string(100'000, 'a')}, ExitCode::command_line, "100000 bytes");
  refuses({"near", "nan", "0"}, ExitCode::command_line, "'nan' is not a coordinate");
  refuses({"near", "1", "inf"}, ExitCode::command_line, "'inf' is not a coordinate");
  refuses({"near", "1"}, ExitCode::command_line, "");
  refuses({"goal", "118", "--from", "nan", "0"}, ExitCode::command_line, "nan");
  refuses({"goal", "118", "--radius", "-1"}, ExitCode::command_line, "-1");
  refuses({"118", "list"}, ExitCode::command_line, "is given before the verb");
}

TEST_F(Query, DamagedFilesAreErrorsThatNameThem) {
  const std::string folder = *scratch_ / "damaged", bytes = readFile(map() + "/map.omnimap");
  fs::create_directories(folder);
  const auto refuses = [&](const std::string& content, const std::string& why) {
    writeFile(folder + "/map.omnimap", content);
    EXPECT_TRUE(endedWith(ExitCode::unreadable_input, ask({"118"}, folder), {folder + "/map.omnimap", why}));
  };
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, ask({"118"}, folder + "/absent"), {"absent"}));
  refuses("", "is no map file");
  refuses(bytes.substr(0, bytes.size() / 2), "truncated");
  refuses(bytes.substr(0, bytes.size() - 5), "truncated");
  std::string damaged = bytes;
  damaged[bytes.size() - 40] ^= 1;  // in the last section, that of the places
  refuses(damaged, "section \"places\": its checksum");
  writeFile(folder + "/map.omnimap", bytes);
  EXPECT_EQ(ask({"118"}, folder).code, 0) << "without a grid";
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, ask({"goal", "118"}, folder), {"grid.yaml: is missing"}));
  fs::copy_file(map() + "/grid.yaml", folder + "/grid.yaml");
  writeFile(folder + "/grid.pgm", readFile(map() + "/grid.pgm").substr(0, 1000));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, ask({"goal", "118"}, folder), {"grid.pgm: is truncated"}));
  writeFile(folder + "/grid.pgm", "P5\n90000 90000\n255\n");
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, ask({"goal", "118"}, folder), {"90000 x 90000 cells"}));
}

TEST_F(Query, ThePlacesAreInTheFileAndNotInTheLoadedMap) {
  EXPECT_TRUE(omnimapper::map::MapFile::read(map() + "/map.omnimap").find(omnimapper::map::Places::kLayer));
  EXPECT_FALSE(loadMap(map()).map.layers.find(omnimapper::map::Places::kLayer));
}

// The places are computed anew from the measurements of both sessions.
TEST_F(Query, AContinuedMapHasItsPlacesOnce) {
  const std::string folder = *scratch_ / "both";
  ASSERT_TRUE(endedWith(
      ExitCode::ok,
      graphslam({"-q", "-i", sourceFile("ini/signs.ini"), "--set", "perception.extractors=laser_points,laser_lines",
                 "--set", "mapper.output_plugins=map", "--set", "session.start=origin", "--set", "source.end_s=5", "-r",
                 office() + "/signs_office.rawlog", "--continue", map(), "-o", folder})));
  const auto ended = ask({"118", "--json"}, folder);
  ASSERT_EQ(ended.code, 0) << toString(ended);
  EXPECT_EQ(json::parse(ended.out)["matches"].size(), 1U);
}

}  // namespace

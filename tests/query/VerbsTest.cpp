#include <gtest/gtest.h>
#include <omnimapper/map/Places.h>
#include <omnimapper/query/Verbs.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "HandMadeMap.h"

namespace omnimapper::query::verbs_test {
namespace {

using nlohmann::json;

class HandMadeFolder : public ::testing::Test {
 protected:
  HandMadeFolder() {
    map::Place women = signAt(1, 3.9, "WOMEN"), others = signAt(3, 3.9, "WOMEN");
    women.normal = others.normal = Eigen::Vector3d(0, -1, 0);
    map_ = {folder_ / "map.omnimap",
            folder_.path(),
            placesOf({signAt(2, 0.1, "213", "Ella Stone"), women, others, signAt(0.1, 2, "98"), wallFrom(0, 0, 4, 0),
                      signAt(3, 2, "\x1b[2J")}),
            {}};
    std::vector<std::string> rows(40, std::string(40, '.'));
    rows.front() = rows.back() = std::string(40, '#');
    for (auto& row : rows) row.front() = row.back() = '#';
    putGrid(folder_.path(), rows, "0.1");
  }
  Answer ask(const std::string& verb, const Request& request) const {
    for (const auto& each : verbs())
      if (each.name == verb) return each.answer(map_, request);
    throw std::logic_error(verb);
  }
  json asked(const std::string& verb, const Request& request) const { return json::parse(ask(verb, request).json); }

  testing::ScratchFolder folder_;
  MapToAsk map_;
};

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST_F(HandMadeFolder, FindSaysWhatIsExactAndWhatIsNear) {
  const Answer exact = ask("find", {{"213"}, {}});
  EXPECT_EQ(exact.code, base::ExitCode::ok);
  EXPECT_TRUE(says(exact.text, "'213' fits 1 landmark")) << exact.text;
  EXPECT_TRUE(says(exact.text, "sign \"213\"") && says(exact.text, "2.00 0.10 1.50") && says(exact.text, "7 x camera"));
  const Answer near = ask("find", {{"2l3"}, {}});
  EXPECT_EQ(near.code, base::ExitCode::ok);
  EXPECT_TRUE(says(near.text, "nothing is called '2l3'; nearest: '213'")) << near.text;
  EXPECT_EQ(json::parse(near.json)["matches"][0]["match"], "near");
  const Answer none = ask("find", {{"777"}, {}});
  EXPECT_EQ(none.code, base::ExitCode::nothing_found);
  EXPECT_TRUE(says(none.text, "nothing is called '777' or similarly; omnimapper-query MAP list")) << none.text;
  EXPECT_EQ(json::parse(none.json)["matches"], json::array());
}

TEST_F(HandMadeFolder, WordsOfACommandLineAreOneText) {
  EXPECT_EQ(asked("find", {{"ella", "stone"}, {}})["matches"][0]["caption"], "213");
}

TEST_F(HandMadeFolder, NothingOfTheMapMovesTheCursor) {
  for (const Answer& answer : {ask("list", {{"sign"}, {}}), ask("near", {{"3", "2"}, {}})}) {
    EXPECT_EQ(answer.text.find('\x1b'), std::string::npos);
    EXPECT_TRUE(says(answer.text, "\\x1b[2J")) << answer.text;
    EXPECT_EQ(answer.json.find('\x1b'), std::string::npos);
  }
}

TEST_F(HandMadeFolder, NearIsByDistance) {
  const auto near = asked("near", {{"2", "1"}, {}});
  ASSERT_EQ(near["places"].size(), 5U);
  EXPECT_EQ(near["places"][0]["caption"], "213");
  EXPECT_NEAR(near["places"][0]["distance_m"].get<double>(), 0.9, 1e-9);
  EXPECT_EQ(near["places"][1]["label"], "wall");
  EXPECT_EQ(asked("near", {{"2", "1"}, {{"within", {0.95}}}})["places"].size(), 1U);
  EXPECT_EQ(ask("near", {{"90", "1"}, {{"within", {1}}}}).code, base::ExitCode::nothing_found);
  for (const char* word : {"nan", "inf", "1e999", "x", "", "1.0x", "-nan", "1e8", "-1e300"})
    EXPECT_NE(refusalOf([&] { ask("near", {{word, "0"}, {}}); }, base::ExitCode::command_line), "") << word;
}

TEST_F(HandMadeFolder, ListCountsKindsAndOrdersByNumber) {
  EXPECT_EQ(asked("list", {})["kinds"], (json{{"sign", 5}, {"wall", 1}}));
  const auto signs = asked("list", {{"signs"}, {}})["places"];
  ASSERT_EQ(signs.size(), 5U);
  EXPECT_EQ(signs[1]["caption"], "98");
  EXPECT_EQ(signs[2]["caption"], "213");
  const Answer none = ask("list", {{"giraffe"}, {}});
  EXPECT_EQ(none.code, base::ExitCode::nothing_found);
  EXPECT_TRUE(says(none.text, "no kind is called 'giraffe'; there are: 'sign', 'wall'")) << none.text;
}

TEST_F(HandMadeFolder, OfSeveralThatFitTheNearestToTheStartIsTheGoal) {
  const Answer answer = ask("goal", {{"women"}, {{"from", {3.5, 2}}}});
  EXPECT_TRUE(says(answer.text, "of 2 matches the one nearest to the start 3.50 2.00")) << answer.text;
  const auto goal = json::parse(answer.json)["goal"];
  EXPECT_NEAR(goal["x_m"].get<double>(), 3, 1e-9);
  EXPECT_NEAR(goal["y_m"].get<double>(), 2.9, 1e-9);
  EXPECT_NEAR(goal["yaw_rad"].get<double>(), M_PI / 2, 1e-9);
  EXPECT_EQ(goal["connected"], true);
  EXPECT_NEAR(asked("goal", {{"women"}, {}})["goal"]["x_m"].get<double>(), 1, 1e-9) << "from the last pose";
}

TEST_F(HandMadeFolder, AGoalThatCannotBeIsSaidToBeSo) {
  const Answer tight = ask("goal", {{"213"}, {{"radius", {3}}}});
  EXPECT_EQ(tight.code, base::ExitCode::nothing_found);
  EXPECT_TRUE(says(tight.text, "is free for a robot of 3 m radius")) << tight.text;
  EXPECT_EQ(ask("goal", {{"777"}, {}}).code, base::ExitCode::nothing_found);
  EXPECT_NE(refusalOf([&] { ask("goal", {{"213"}, {{"radius", {1e9}}}}); }, base::ExitCode::command_line), "");
  EXPECT_NE(refusalOf([&] { ask("goal", {{"213"}, {{"from", {NAN, 0}}}}); }, base::ExitCode::command_line), "");
  EXPECT_NE(refusalOf([&] { ask("goal", {{"213"}, {{"from", {1e8, 0}}}}); }, base::ExitCode::command_line), "");
  const auto places = map_.places.places;
  for (auto& place : map_.places.places)
    for (auto& point : place.extent.points) point.x() += 100;
  const Answer outside = ask("goal", {{"213"}, {}});
  EXPECT_EQ(outside.code, base::ExitCode::nothing_found);
  EXPECT_TRUE(says(outside.text, "lies outside the occupancy grid")) << outside.text;
  map_.places.places = places;
  for (auto& place : map_.places.places) place.moved = true;
  EXPECT_EQ(ask("goal", {{"213"}, {}}).code, base::ExitCode::nothing_found);
  map_.places.last_pose.reset();
  EXPECT_NE(refusalOf(
                [&] {
                  ask("goal", {{"213"}, {}});
                },
                base::ExitCode::command_line)
                .find("--from"),
            std::string::npos);
}

TEST_F(HandMadeFolder, AMapIsOpenedByFolderOrFileAndEachDefectIsNamed) {
  map::MapFile file;
  file.set({"graph", 1, "of any bytes"});
  const auto refusal = [&] { return refusalOf([&] { openMap(folder_.path()); }, base::ExitCode::unreadable_input); };
  EXPECT_TRUE(says(refusal(), "has no map.omnimap") && says(refusal(), "MapOutput"));
  EXPECT_TRUE(says(refusalOf([] { openMap(""); }, base::ExitCode::command_line), "MAP is empty"));
  file.write(map_.file);
  EXPECT_TRUE(says(refusal(), "has no section \"places\"") && says(refusal(), "--continue"));
  file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(map_.places)));
  file.write(map_.file);
  EXPECT_EQ(openMap(folder_.path()).places.places.size(), 6U);
  EXPECT_EQ(openMap(map_.file).folder, folder_.path());
  map_ = openMap(folder_.path());
  const auto layers = asked("layers", {})["layers"];
  ASSERT_EQ(layers.size(), 1U) << "the graph is no layer";
  EXPECT_EQ(layers[0]["name"], "places");
  EXPECT_EQ(layers[0]["version"], 2);
  EXPECT_GT(layers[0]["bytes"], 100);
  file.set({"places", 3, ""});
  file.write(map_.file);
  EXPECT_TRUE(says(refusal(), map_.file) && says(refusal(), "version 3"));
  file.set({"places", 1, "\1\1\1\1"});
  file.write(map_.file);
  EXPECT_TRUE(says(refusal(), "truncated"));
  putFile(map_.file, "no map");
  EXPECT_TRUE(says(refusal(), "is no map file"));
  std::filesystem::remove(map_.file);
  file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(map_.places)));
  file.write(folder_ / "checkpoint.omnimap");
  EXPECT_EQ(openMap(folder_.path()).places.places.size(), 6U) << "while a live run goes on";
}

}  // namespace
}  // namespace omnimapper::query::verbs_test

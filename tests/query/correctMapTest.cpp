// Corrections of a map: deleted landmarks and forbidden loop closures.
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/Verbs.h>
#include <omnimapper/query/editLabels.h>

#include <functional>

#include "MapWithFrames.h"
#include "omnimapper/query/correctMap.h"

namespace omnimapper::query::correct_map_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

class CorrectMap : public MapWithFrames {
 protected:
  CorrectMap() {
    write();
    map::ClosedLoops closed;
    closed.loops = {{{0, 1}, {0, 0}, {6, 1}, {1, 1}, "loop_closure", "2.5 m apart"}};
    auto file = map::MapFile::read(map_.file);
    file.set(map::layerToSection(map::ClosedLoops::kLayer, map::LayerOf<map::ClosedLoops>(closed)));
    file.write(map_.file);
  }
  std::string correct(const Words& words) {
    return correctMap(folder_.path(), {words, "anna", base::stampFromUnix(1'700'000'500)});
  }
  void isRefused(const Words& words) {
    const std::string before = bytes();
    EXPECT_FALSE(refusalOf([&] { correct(words); }, base::ExitCode::command_line).empty()) << json(words);
    EXPECT_EQ(bytes(), before) << "nothing changes";
  }
  std::string bytes() const {
    std::ifstream in(map_.file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  MapToAsk map() const { return openMap(map_.file); }
  bool has(const std::string& id) const {
    const auto all = map();
    return placeWithId(all.places.places, id);
  }
  static bool placeWithId(const std::vector<map::Place>& places, const std::string& id) {
    return std::any_of(places.begin(), places.end(), [&](const auto& place) { return hasId(place, id); });
  }
  json answer(const std::string& verb) const {
    for (const auto& each : verbs())
      if (each.name == verb) return json::parse(each.answer(map(), {}).json);
    return {};
  }
};

TEST_F(CorrectMap, ADeletedThingIsNotFoundAndCanBeRestored) {
  const std::string before = bytes();
  EXPECT_EQ(correct({"delete", "0:2"}), "bed 0:2 is deleted");
  EXPECT_FALSE(has("0:2"));
  EXPECT_TRUE(has("0:1"));
  const auto deleted = answer("deleted")["deleted"];
  ASSERT_EQ(deleted.size(), 1U);
  EXPECT_EQ(deleted[0]["id"], "0:2");
  EXPECT_EQ(deleted[0]["who"], "anna");
  isRefused({"delete", "0:2"});
  EXPECT_EQ(correct({"restore", "0:2"}), "bed 0:2 is in the map again");
  EXPECT_EQ(bytes(), before) << "nothing is left of it";
  isRefused({"restore", "0:2"});
}

TEST_F(CorrectMap, TheNumberOfAnyFaceDeletesTheThingWithAllItsLandmarks) {
  correct({"delete", "0:9"});
  EXPECT_FALSE(has("0:3"));
  const auto corrections = map().corrections;
  ASSERT_EQ(corrections.deleted.size(), 1U);
  EXPECT_EQ(map::landmarksOf(corrections.deleted[0].place), (std::vector<base::LandmarkId>{{0, 3}, {0, 9}}));
  EXPECT_EQ(corrections.references().landmarks.size(), 2U);
}

TEST_F(CorrectMap, ANameOfADeletedThingStaysAsThatOfItsSpotAndComesBackWithIt) {
  map::LabelEdits history;
  editLabels(folder_.path(), {{"name", "0:2", "Anna's bed"}, "anna", {}}, history);
  const std::string named = bytes();
  correct({"delete", "0:2"});
  const auto places = map().places.places;
  EXPECT_EQ(places.back().kind, map::Labels::kPlace);
  EXPECT_EQ(places.back().label, "Anna's bed");
  correct({"restore", "0:2"});
  EXPECT_EQ(bytes(), named);
}

TEST_F(CorrectMap, AForbiddenLoopIsRememberedUntilItIsAllowedAgain) {
  const std::string before = bytes();
  EXPECT_FALSE(answer("loops")["loops"][0]["is_forbidden"]);
  EXPECT_NE(correct({"forbid", "0:1", "0:0"}).find("the next session"), std::string::npos);
  EXPECT_TRUE(answer("loops")["loops"][0]["is_forbidden"]);
  isRefused({"forbid", "0:1", "0:0"});
  EXPECT_EQ(correct({"allow", "0:1", "0:0"}), "the loop closure is allowed again");
  EXPECT_EQ(bytes(), before);
  isRefused({"allow", "0:1", "0:0"});
}

// What the run writes at its end would replace what was confirmed.
TEST_F(CorrectMap, NothingIsChangedWhileARunWritesIntoTheFolder) {
  const std::string before = bytes();
  map::LabelEdits history;
  const auto name = [&] { editLabels(folder_.path(), {{"name", "0:2", "Anna's bed"}, "anna", {}}, history); };
  base::OutputFolder run(folder_.path());
  run.open();
  for (const std::function<void()>& edit : {std::function<void()>(name), {[&] { correct({"delete", "0:2"}); }}})
    EXPECT_NE(refusalOf(edit, base::ExitCode::unreadable_input).find("has not ended"), std::string::npos);
  EXPECT_EQ(bytes(), before);
  run.release();
  EXPECT_EQ(correct({"delete", "0:2"}), "bed 0:2 is deleted");
  EXPECT_NO_THROW(editLabels(folder_.path(), {{"name", "0:1", "hot plate"}, "anna", {}}, history));
}

TEST_F(CorrectMap, WhatIsNoCorrectionIsRefused) {
  for (const auto& words : {Words{},
                            {"delete"},
                            {"delete", "0:77"},
                            {"delete", "bed"},
                            {"forbid", "0:0", "0:1"},
                            {"forbid", "0:1"},
                            {"undo"},
                            {"erase", "0:2"}})
    isRefused(words);
}

}  // namespace
}  // namespace omnimapper::query::correct_map_test

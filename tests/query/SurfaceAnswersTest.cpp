// Questions about two tables with things on them that are made by hand.
#include <gtest/gtest.h>

#include "TwoRooms.h"

namespace omnimapper::query::surface_answers_test {
namespace {

using base::ExitCode;
using nlohmann::json;

map::Place objectOn(const char* surface, double x, double seen, double looked) {
  map::Place thing = thingAt(x, 1, "object");
  thing.last_seen = base::stampFromUnix(1'700'000'000 + seen);
  thing.properties = {{"seen_in", std::uint64_t{7}},
                      {"last_seen_at", thing.last_seen},
                      {"last_looked_at", base::stampFromUnix(1'700'000'000 + looked)},
                      {"on", std::string(surface)}};
  return thing;
}

/// Tables 0:0 and 0:1. On the first are two objects, of which 0:3 is gone, on the second is a mug.
class SurfaceAnswers : public ::testing::Test {
 protected:
  SurfaceAnswers() {
    map::Place first = thingAt(1, 1, "table"), second = thingAt(5, 1, "table"), gone = objectOn("0:0", 1.5, 20, 40);
    first.last_seen = second.last_seen = base::stampFromUnix(1'700'000'030);
    gone.moved = true;
    map::Place mug = objectOn("0:1", 5, 10, 10);
    mug.label = mug.kind = "mug";
    map_.places = placesOf({first, second, objectOn("0:0", 1, 20, 20), gone, mug, thingAt(9, 9, "object")});
  }
  Answer ask(const std::string& name, Request request) const {
    for (const auto& verb : verbs())
      if (verb.name == name) return verb.answer(map_, request);
    throw std::logic_error(name);
  }
  static Request objectsOn(const std::string& surface, const std::string& text = "object") {
    Request request{{text}, {}};
    request.texts["on"] = surface;
    return request;
  }
  static bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

  MapToAsk map_;
};

TEST_F(SurfaceAnswers, WhatStandsOnAFaceOfAThingStandsOnTheThing) {
  map_.places.places[1].properties = {{map::kParts, std::string("0:1, 0:17")}};
  map_.places.places[4].properties.back().value = std::string("0:17");
  EXPECT_TRUE(says(ask("looked", {{"0:1"}, {}}).text, "mug"));
  EXPECT_EQ(ask("find", objectsOn("0:1", "mug")).code, ExitCode::ok);
}

TEST_F(SurfaceAnswers, LookedSaysWhatWasSeenWhatIsGoneAndWhenItWasLookedAt) {
  const Answer answer = ask("looked", {{"0:0"}, {}});
  EXPECT_EQ(answer.code, ExitCode::ok);
  EXPECT_TRUE(says(answer.text, "table (0:0), looked at last 2023-11-14 22:14:00: 1 thing, 1 gone")) << answer.text;
  EXPECT_TRUE(says(answer.text, "7 / 0 / 0") && says(answer.text, "22:13:40") && says(answer.text, "there"));
  const auto surface = json::parse(answer.json)["surfaces"][0];
  EXPECT_EQ(surface["id"], "0:0");
  EXPECT_EQ(surface["last_looked"], "2023-11-14T22:14:00Z") << "when the thing that is gone was looked for";
  ASSERT_EQ(surface["things"].size(), 2U);
  EXPECT_EQ(surface["things"][0]["last_looked"], "2023-11-14T22:13:40Z");
  EXPECT_EQ(surface["things"][1]["state"], "moved");
}

TEST_F(SurfaceAnswers, LookedNamesAllSurfacesThatFit) {
  const auto surfaces = json::parse(ask("looked", {{"tables"}, {}}).json)["surfaces"];
  ASSERT_EQ(surfaces.size(), 2U);
  EXPECT_EQ(surfaces[1]["things"][0]["label"], "mug");
  EXPECT_EQ(surfaces[1]["last_looked"], "2023-11-14T22:13:50Z") << "the table itself was seen after the mug";
  EXPECT_EQ(ask("looked", {{"piano"}, {}}).code, ExitCode::nothing_found);
  EXPECT_NE(refusalOf([&] { ask("looked", {{" "}, {}}); }, ExitCode::command_line), "");
}

TEST_F(SurfaceAnswers, OnASurfaceWithoutThingsNothingWasSeen) {
  map_.places.places.resize(2);
  const Answer answer = ask("looked", {{"0:1"}, {}});
  EXPECT_EQ(answer.code, ExitCode::ok);
  EXPECT_TRUE(says(answer.text, "looked at last 2023-11-14 22:13:50: nothing was seen on it")) << answer.text;
}

TEST_F(SurfaceAnswers, FindOnFindsOnlyWhatStandsThere) {
  const Answer all = ask("find", objectsOn("table"));
  EXPECT_EQ(json::parse(all.json)["matches"].size(), 1U) << "one is gone, and one stands on nothing that is known";
  EXPECT_TRUE(says(all.text, "0:2") && !says(all.text, "0:5")) << all.text;
  const Answer none = ask("find", objectsOn("0:1"));
  EXPECT_EQ(none.code, ExitCode::nothing_found);
  EXPECT_TRUE(says(none.text, "nothing on '0:1' is called 'object' or similarly; there are: 'mug'")) << none.text;
  EXPECT_EQ(json::parse(ask("find", objectsOn("0:1", "mug")).json)["matches"].size(), 1U);
  EXPECT_TRUE(says(ask("find", objectsOn("0:5")).text, "nothing is on '0:5'"));
  const Answer unknown = ask("find", objectsOn("piano"));
  EXPECT_EQ(unknown.code, ExitCode::nothing_found);
  EXPECT_TRUE(says(unknown.text, "nothing is called 'piano'")) << unknown.text;
  EXPECT_EQ(json::parse(ask("find", {{"object"}, {}}).json)["matches"].size(), 3U);
}

TEST_F(SurfaceAnswers, NoNameMovesTheCursor) {
  map_.places.places[4].label = "\x1b[2J";
  for (const auto& answer :
       {ask("looked", {{"table"}, {}}), ask("find", objectsOn("0:1")), ask("find", objectsOn("0:1", "2J"))})
    EXPECT_EQ((answer.text + answer.json).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::query::surface_answers_test

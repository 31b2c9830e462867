// Questions about two rooms that are made by hand.
#include <gtest/gtest.h>
#include <omnimapper/map/Labels.h>

#include "TwoRooms.h"

namespace omnimapper::query::room_answers_test {
namespace {

using base::ExitCode;
using RoomAnswers = TwoRooms;

TEST_F(RoomAnswers, RoomsListsWhatWasSeenAndWhatIsBehindDoors) {
  const Answer answer = ask("rooms", {});
  EXPECT_TRUE(says(answer.text, "2 rooms, 1 door\n")) << answer.text;
  EXPECT_TRUE(says(answer.text, "kitchen (90 %)") && says(answer.text, "room 1"));
  EXPECT_TRUE(says(answer.text, "118") && says(answer.text, "6.00 4.00")) << answer.text;
  const auto json = nlohmann::json::parse(answer.json);
  EXPECT_EQ(json["map_id"], "0123456789abcdef");
  EXPECT_EQ(json["frame"], "map");
  EXPECT_EQ(json["map_time"], "2023-11-14T22:15:00Z");
  EXPECT_EQ(json["rooms"][0]["doors"][0]["to"]["id"], "room 2");
  EXPECT_EQ(json["unseen"][0]["seen_from"], "room 2");
}

TEST_F(RoomAnswers, WhereAmIIsTheRoomOfThePointOrOfTheLastPose) {
  EXPECT_TRUE(says(ask("where", {"am", "i"}).text, "1.00 1.00 is in kitchen (room 1)"));
  EXPECT_TRUE(says(ask("where", {"am", "I", "7", "3"}).text, "is in room 2"));
  const Answer outside = ask("where", {"9.9", "2"});
  EXPECT_EQ(outside.code, ExitCode::nothing_found);
  EXPECT_TRUE(says(outside.text, "is in no room; room 2 is 2.0 m away")) << outside.text;
  EXPECT_TRUE(says(ask("where", {"is", "bed"}).text, "7.00 1.00")) << "the question for a thing";
  EXPECT_NE(refusalOf([&] { ask("where", {"am", "i", "7"}); }, ExitCode::command_line), "");
  EXPECT_NE(refusalOf([&] { ask("where", {"am", "i", "x", "y"}); }, ExitCode::command_line), "");
}

TEST_F(RoomAnswers, InListsTheThingsOfARoomAndSaysWhatWasNotSeen) {
  const Answer kitchen = ask("in", {"the", "kitchen"});
  EXPECT_TRUE(says(kitchen.text, "kitchen (room 1), 14.8 m2: 3 landmarks")) << kitchen.text;
  EXPECT_TRUE(says(kitchen.text, "contents: kitchen by 1 counter (90 %)"));
  EXPECT_TRUE(says(kitchen.text, "counter") && says(kitchen.text, "seat") && !says(kitchen.text, "bed"));
  EXPECT_EQ(asked("in", {"room", "2"})["rooms"][0]["places"].size(), 2U) << "the bed, and the sign that faces it";
  const Answer unseen = ask("in", {"118"});
  EXPECT_EQ(unseen.code, ExitCode::ok);
  EXPECT_TRUE(says(unseen.text, "118 (not seen): its door is at 6.00 4.00")) << unseen.text;
  const Answer none = ask("in", {"attic"});
  EXPECT_EQ(none.code, ExitCode::nothing_found);
  EXPECT_TRUE(says(none.text, "there are: kitchen (room 1), room 2, 118")) << none.text;
  EXPECT_EQ(ask("in", {"room", "7"}).code, ExitCode::nothing_found) << "another number is another room";
}

TEST_F(RoomAnswers, WhichRoomNamesTheRoomOfEachThing) {
  EXPECT_TRUE(says(ask("which", {"room", "is", "the", "bed", "in"}).text, "room 2"));
  const Answer seats = ask("which", {"rooms", "are", "chairs", "in"});
  EXPECT_TRUE(says(seats.text, "kitchen (room 1)") && says(seats.text, "in no room")) << seats.text;
  const auto json = nlohmann::json::parse(seats.json);
  EXPECT_EQ(json["matches"][0]["match"], "other word");
  EXPECT_EQ(json["matches"][0]["name"], "seat");
  EXPECT_EQ(ask("which", {"room", "is", "piano", "in"}).code, ExitCode::nothing_found);
}

TEST_F(RoomAnswers, GoalOfARoomIsItsCentreMovedToWhereTheRobotFits) {
  const auto kitchen = asked("goal", {"kitchen"});
  EXPECT_NEAR(kitchen["goal"]["x_m"].get<double>(), 2.05, 0.06);
  EXPECT_NEAR(kitchen["goal"]["y_m"].get<double>(), 2, 0.06);
  EXPECT_EQ(kitchen["goal"]["connected"], true);
  EXPECT_EQ(kitchen["room"]["id"], "room 1");
  // The column in the middle of room 2 reaches to 0.3 m from (6, 2), and the robot needs 0.25 m more.
  const auto other = asked("goal", {"room", "2"});
  const double moved = other["goal"]["moved_m"];
  EXPECT_GT(moved, 0.5);
  EXPECT_LT(moved, 0.8);
  EXPECT_TRUE(says(ask("goal", {"room", "2"}).text, "moved by"));
  EXPECT_EQ(asked("goal", {"bed"})["target"]["label"], "bed") << "landmarks are targets as before";
  EXPECT_EQ(asked("goal", {"118"})["target"]["caption"], "118") << "the room was not seen, its sign was";
}

TEST_F(RoomAnswers, GoalOfARegionIsItsMiddleMovedToWhereTheRobotFitsInIt) {
  map::Place region = thingAt(6, 2, "reading corner");
  region.kind = map::Labels::kRegion;
  region.id = {0, 4294967295U};
  region.extent.points.clear();
  region.extent.outlines = {{{5, 1}, {7, 1}, {7, 3}, {5, 3}}};
  map_.places.places.push_back(region);
  const auto json = asked("goal", {"reading corner"});
  EXPECT_EQ(json["target"]["label"], "reading corner");
  const double x = json["goal"]["x_m"], y = json["goal"]["y_m"], moved = json["goal"]["moved_m"];
  EXPECT_TRUE(x > 5 && x < 7 && y > 1 && y < 3) << x << " " << y;
  EXPECT_NEAR(moved, std::hypot(x - 6, y - 2), 1e-9);
  EXPECT_GT(moved, 0.5) << "the column is in its middle";
  EXPECT_EQ(json["goal"]["connected"], true);
  EXPECT_TRUE(says(ask("goal", {"reading corner"}).text, "the centre of the region, moved by"));
  EXPECT_EQ(asked("goal", {"0:4294967295"})["target"]["label"], "reading corner");
  const auto path = asked("path", {"here", "to", "reading corner"});
  EXPECT_GT(path["length_m"].get<double>(), 4);
  // Two tables without free space between them are approached from outside.
  map_.places.places.back().extent.outlines = {{{5.7, 1.7}, {6.3, 1.7}, {6.3, 2.3}, {5.7, 2.3}}};
  const auto before = asked("goal", {"reading corner"})["goal"];
  EXPECT_EQ(before.count("moved_m"), 0U);
  EXPECT_NEAR(before["distance_m"].get<double>(), 1, 0.3);
}

TEST_F(RoomAnswers, PathHasItsLengthAndTheRoomsAndDoorsOnIt) {
  const Answer answer = ask("path", {"here", "to", "bed"});
  EXPECT_EQ(answer.code, ExitCode::ok) << answer.text;
  EXPECT_TRUE(says(answer.text, "from kitchen (room 1)\n") && says(answer.text, "through door 1 to room 2"))
      << answer.text;
  const auto json = asked("path", {"from", "kitchen", "to", "7,3"});
  // From (2.05, 2.05) through the door to (7, 3): straight ahead, and around the column.
  EXPECT_GT(json["length_m"].get<double>(), std::hypot(4.95, 1));
  EXPECT_LT(json["length_m"].get<double>(), 6);
  ASSERT_EQ(json["rooms"].size(), 2U);
  EXPECT_EQ(json["rooms"][1]["through"], "door 1");
  EXPECT_EQ(ask("path", {"here", "to", "20,2"}).code, ExitCode::nothing_found);
  EXPECT_EQ(ask("path", {"here", "to", "attic"}).code, ExitCode::nothing_found);
  EXPECT_NE(refusalOf([&] { ask("path", {"a", "b", "c"}); }, ExitCode::command_line), "");
}

TEST_F(RoomAnswers, APathIsNotThroughDoorsThatAreTooNarrow) {
  for (const auto& verb : verbs())
    if (verb.name == "path") {
      const Answer wide = verb.answer(map_, {{"kitchen", "room 2"}, {{"radius", {0.6}}}});
      EXPECT_EQ(wide.code, ExitCode::nothing_found);
      EXPECT_TRUE(says(wide.text, "for a robot of 0.6 m radius")) << wide.text;
    }
}

TEST_F(RoomAnswers, RoomsThatAreSaidToBeEndlessAreSearchedInTheGridAlone) {
  map_.rooms->rooms[1] = roomBetween(2, 4.1, -1e6, 1e6, 1e6);
  const auto goal = asked("goal", {"room", "2"})["goal"];
  EXPECT_GT(goal["x_m"].get<double>(), 4.1);
  EXPECT_LT(goal["x_m"].get<double>(), 8);
  EXPECT_EQ(goal["connected"], true);
  for (const bool has_pose : {true, false}) {
    if (!has_pose) map_.places.last_pose.reset();
    EXPECT_EQ(ask("path", {"room", "2", "to", "kitchen"}).code, ExitCode::ok);
    EXPECT_EQ(ask("between", {"kitchen", "and", "room", "2"}).code, ExitCode::ok);
    EXPECT_EQ(ask("in", {"room", "2"}).code, ExitCode::ok);
  }
}

TEST_F(RoomAnswers, BetweenAreDoorsRoomsOnTheWayAndThingsOnTheLine) {
  const Answer rooms = ask("between", {"kitchen", "and", "room", "2"});
  EXPECT_TRUE(says(rooms.text, "door 1 at 4.05 2.00 joins them")) << rooms.text;
  const auto things = asked("between", {"counter", "and", "seat"});
  ASSERT_EQ(things["places"].size(), 1U) << "the table; the bed is in another direction";
  EXPECT_EQ(things["places"][0]["label"], "table");
  EXPECT_EQ(ask("between", {"counter", "and", "attic"}).code, ExitCode::nothing_found);
}

TEST_F(RoomAnswers, FindKnowsRoomsIdsAndOtherWords) {
  const Answer kitchen = ask("find", {"kitchen"});
  EXPECT_EQ(kitchen.code, ExitCode::ok);
  EXPECT_TRUE(says(kitchen.text, "kitchen (room 1): its centre is at 2.05 2.00")) << kitchen.text;
  EXPECT_EQ(asked("find", {"0:2"})["matches"][0]["label"], "bed") << "an id that was printed";
  EXPECT_EQ(asked("find", {"couch"})["matches"].size(), 2U);
  EXPECT_EQ(asked("find", {"beds"})["matches"][0]["match"], "other word");
  const auto sign = asked("find", {"118"});
  EXPECT_EQ(sign["matches"][0]["room"]["id"], "room 2");
  EXPECT_EQ(sign["rooms"][0]["is_seen"], false);
}

TEST_F(RoomAnswers, AMapWithoutRoomsSaysHowToGetThem) {
  map_.rooms.reset();
  for (const char* verb : {"rooms", "where", "in", "which"})
    EXPECT_TRUE(says(refusalOf([&] { ask(verb, {"bed"}); }, ExitCode::unreadable_input), "RoomsPlugin")) << verb;
  EXPECT_EQ(ask("path", {"here", "to", "bed"}).code, ExitCode::ok) << "a way needs no rooms";
  EXPECT_EQ(ask("find", {"bed"}).code, ExitCode::ok);
}

TEST_F(RoomAnswers, BriefJsonHasOnlyNamesAndPositions) {
  Request request{{"bed"}, {}};
  request.brief = true;
  for (const auto& verb : verbs())
    if (verb.name == "find") {
      const auto json = nlohmann::json::parse(verb.answer(map_, request).json);
      EXPECT_FALSE(json["matches"][0].contains("extent"));
      EXPECT_EQ(json["matches"][0]["position_m"][0], 7);
    }
}

TEST_F(RoomAnswers, NoNameOfARoomMovesTheCursor) {
  map_.rooms->rooms[0].name = "\x1b[2J";
  map_.rooms->unseen[0].name = "\x1b[2J";
  for (const auto& answer : {ask("rooms", {}), ask("in", {"room", "1"}), ask("where", {"1", "1"}), ask("in", {"attic"}),
                             ask("path", {"here", "to", "room 2"})}) {
    EXPECT_EQ(answer.text.find('\x1b'), std::string::npos) << answer.text;
    EXPECT_EQ(answer.json.find('\x1b'), std::string::npos);
  }
}

}  // namespace
}  // namespace omnimapper::query::room_answers_test

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/building/RoomEdits.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "PaintedPlan.h"

namespace omnimapper::building::room_edits_test {
namespace {

using Kind = RoomEdit::Kind;

/// A corridor of 12 m x 2 m with three rooms of 3.9 m x 4 m above it.
class RoomEditsOfPlan : public ::testing::Test {
 protected:
  const Room& at(double x, double y) const { return *roomAt(rooms_.storey, {x, y}); }
  std::string apply(const RoomEdit& edit) { return applyEdit(edit, plan_.grid(), rooms_); }
  /// Each cell's room, each neighbour and each room of a door is there.
  void expectWhole() const {
    for (const int id : rooms_.room_of_cell) ASSERT_TRUE(id == 0 || roomOf(rooms_.storey, id));
    for (const auto& room : rooms_.storey.rooms)
      for (const int id : room.neighbours) EXPECT_NE(roomOf(rooms_.storey, id), nullptr);
    for (const auto& door : rooms_.storey.doors)
      for (const int id : door.rooms) EXPECT_NE(roomOf(rooms_.storey, id), nullptr);
  }

  PaintedPlan plan_ = corridorWithRooms();
  Segmentation rooms_ = segmentRooms(plan_.grid());
};

TEST_F(RoomEditsOfPlan, RenameGivesANameThatIsSure) {
  EXPECT_EQ(apply({Kind::rename, "Library", {{2, 4}}}), "");
  EXPECT_EQ(nameOf(at(2, 4)), "Library");
  EXPECT_EQ(at(2, 4).name_confidence, 1);
  EXPECT_EQ(apply({Kind::rename, "Archive", {{2, 4}}}), "");
  EXPECT_EQ(at(2, 4).why.size(), 1U) << "the last name counts";
  EXPECT_EQ(apply({Kind::rename, "Moon", {{50, 50}}}), "there is no room at 50.00 50.00");
}

TEST_F(RoomEditsOfPlan, MergeJoinsTwoRoomsThatHaveADoor) {
  const int corridor = at(6, 1).id, id = at(2, 4).id;
  const double area = at(6, 1).area + at(2, 4).area;
  EXPECT_EQ(apply({Kind::merge, "", {{2, 4}, {6, 1}}}), "");
  EXPECT_LT(id, corridor);
  EXPECT_EQ(at(2, 4).id, id) << "the lower id stays, though that room is the smaller one";
  EXPECT_EQ(at(6, 1).id, id);
  EXPECT_NEAR(at(2, 4).area, area, 0.5);
  EXPECT_EQ(rooms_.storey.rooms.size(), 3U);
  EXPECT_EQ(rooms_.storey.doors.size(), 2U);
  expectWhole();
  EXPECT_NE(apply({Kind::merge, "", {{5, 4}, {10, 4}}}), "") << "a wall is between them";
  EXPECT_NE(apply({Kind::merge, "", {{5, 4}, {5, 5}}}), "") << "one room";
}

TEST_F(RoomEditsOfPlan, MergeKeepsTheNameThatAUserGave) {
  for (Room& room : rooms_.storey.rooms) {
    room.name = "sign " + std::to_string(room.id);
    room.why = {{NameEvidence::Source::sign, room.name, 0.9}};
  }
  EXPECT_EQ(apply({Kind::rename, "Lobby", {{6, 1}}}), "");
  EXPECT_EQ(apply({Kind::merge, "", {{2, 4}, {6, 1}}}), "");
  EXPECT_EQ(at(2, 4).name, "Lobby") << "the corridor has the higher id";
  EXPECT_EQ(at(2, 4).name_confidence, 1);
  EXPECT_EQ(apply({Kind::merge, "", {{10, 4}, {6, 1}}}), "");
  EXPECT_EQ(at(10, 4).name, "Lobby");
}

TEST_F(RoomEditsOfPlan, LinesAndDoorsFarAwayAreRefused) {
  const Storey before = rooms_.storey;
  EXPECT_NE(apply({Kind::split, "", {{7, -1e5}, {7, 1e5 + 2}}}).find("far outside of all rooms"), std::string::npos);
  EXPECT_NE(apply({Kind::move_door, "", {{5.4, 2}, {0, 0}, {2e7, 0}}}).find("at most 20 m wide"), std::string::npos);
  EXPECT_NE(apply({Kind::move_door, "", {{5.4, 2}, {1e200, 0}, {-1e200, 0}}}).find("wide"), std::string::npos);
  EXPECT_NE(apply({Kind::move_door, "", {{5.4, 2}, {20, 2}, {21, 2}}}).find("moves by at most 5 m"), std::string::npos);
  ASSERT_EQ(rooms_.storey.doors.size(), before.doors.size());
  for (std::size_t i = 0; i < before.doors.size(); ++i)
    EXPECT_EQ(rooms_.storey.doors[i].width, before.doors[i].width) << "nothing was changed";
}

TEST_F(RoomEditsOfPlan, SplitCutsARoomAtALineAndMakesADoorThere) {
  const int corridor = at(6, 1).id;
  EXPECT_NE(apply({Kind::split, "", {{7, 0.5}, {7, 1}}}), "") << "it does not reach the walls";
  EXPECT_EQ(apply({Kind::split, "", {{7, 0}, {7, 2}}}), "");
  EXPECT_EQ(at(3, 1).id, corridor) << "7 m of 12";
  EXPECT_NEAR(at(3, 1).area, 14, 0.6);
  EXPECT_EQ(at(10, 1).split_from, std::optional<int>(corridor));
  EXPECT_EQ(at(10, 1).neighbours.size(), 2U) << "the other part, and the room at its door";
  EXPECT_EQ(at(3, 1).neighbours.size(), 3U);
  expectWhole();
}

TEST_F(RoomEditsOfPlan, DeleteLeavesNoRoomAndMoveDoorMovesTheNearest) {
  EXPECT_EQ(apply({Kind::remove, "", {{2, 4}}}), "");
  EXPECT_EQ(roomAt(rooms_.storey, {2, 4}), nullptr);
  EXPECT_EQ(apply({Kind::remove, "", {{4, 4}}}), "there is no room at 4.00 4.00") << "0.05 m beside its neighbour";
  EXPECT_EQ(rooms_.storey.doors.size(), 2U);
  expectWhole();
  EXPECT_EQ(apply({Kind::move_door, "", {{5.4, 2}, {6, 2.05}, {7, 2.05}}}), "");
  EXPECT_TRUE(std::any_of(rooms_.storey.doors.begin(), rooms_.storey.doors.end(),
                          [](const Door& door) { return door.width == 1 && door.opening.from.x() == 6; }));
  EXPECT_NE(apply({Kind::move_door, "", {{1.4, 2}, {6, 2}, {7, 2}}}), "") << "that door is gone";
}

TEST_F(RoomEditsOfPlan, EditsAreReadBackAndDefectsAreNamed) {
  RoomEdits edits{{{Kind::rename, "Café", {{2, 4}}}, {Kind::split, "", {{7, 0}, {7, 2}}}}, {}, {{"213", {2, 2}}}};
  edits = anchoredTo(edits, rooms_.storey, edits.signs);
  const std::string text = encodeEdits(edits);
  EXPECT_EQ(encodeEdits(decodeEdits(text, "test")), text);
  testing::ScratchFolder folder;
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    std::ofstream(folder / "edits.json") << changed.replace(changed.find(from), from.size(), to);
    try {
      readEdits(folder / "edits.json");
    } catch (const base::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("213", "214"), "");
  EXPECT_NE(refusal("\"omnimapper-room-edits\"", "\"rooms\"").find("no document of edits"), std::string::npos);
  EXPECT_NE(refusal("\"version\": 1", "\"version\": 2").find("another version"), std::string::npos);
  EXPECT_NE(refusal("\"rename\"", "\"paint\"").find("'paint' is no edit"), std::string::npos);
  EXPECT_NE(refusal("\"split\"", "\"rename\"").find("number of points"), std::string::npos);
  EXPECT_NE(refusal("[\n    2.0", "[\n    2e300").find("too far"), std::string::npos) << text;
}

TEST(MovedEdits, AreInReachOfADocument) {
  const RoomEdits edits{{{Kind::rename, "Library", {{1e6, 2}}}}, {{{1e6, 1e6}, {0, 0}, {1, 0}}}, {{"213", {-1e6, 0}}}};
  const std::string text = encodeEdits(moved(edits, {9e5, 3, 0.5}));
  EXPECT_EQ(encodeEdits(decodeEdits(text, "test")), text);
  EXPECT_EQ(moved(edits, {1, 2, 0}).outlines[0][1], Eigen::Vector2d(1, 2));
}

/// Edits of the corridor, taken over by a plan in another frame.
TEST_F(RoomEditsOfPlan, EditsFindTheirRoomsInAMapWithAnotherFrame) {
  plan_.room(4.05, 2.1, 7.95, 9).free(5, 2, 5.9, 2.1);  // the plan is not its own mirror image
  rooms_ = segmentRooms(plan_.grid());
  const RoomEdits edits = anchoredTo({{{Kind::rename, "Library", {{2, 4}}}}, {}, {}}, rooms_.storey, {});
  EXPECT_LT(minus(*alignEdits(edits, rooms_.storey, {}), {}).norm(), 1e-9) << "the same frame";
  const geometry::Se2 now_from_then{20, -7, 2.1};
  grid::GridMap grid = plan_.grid();
  grid.map_from_grid = now_from_then * grid.map_from_grid;
  Segmentation again = segmentRooms(grid);
  const auto found = alignEdits(edits, again.storey, {});
  ASSERT_TRUE(found);
  EXPECT_LT(minus(*found, now_from_then).norm(), 0.2);
  EXPECT_EQ(applyEdit(moved(edits, *found).edits.front(), grid, again), "");
  EXPECT_EQ(nameOf(*roomAt(again.storey, now_from_then * Eigen::Vector2d(2, 4))), "Library");
}

// The rooms that the edits remember are those after the edits, and a new map has the rooms that were before them.
TEST_F(RoomEditsOfPlan, EditsThatChangedTheRoomsFindTheirPlaceToo) {
  plan_.room(4.05, 2.1, 7.95, 9).free(5, 2, 5.9, 2.1);
  rooms_ = segmentRooms(plan_.grid());
  const std::vector<RoomEdit> made{{Kind::split, "", {{7, 0}, {7, 2}}}, {Kind::remove, "", {{2, 4}}}};
  for (const RoomEdit& edit : made) ASSERT_EQ(apply(edit), "");
  const RoomEdits edits = anchoredTo({made, {}, {}}, rooms_.storey, {});
  const geometry::Se2 now_from_then{-12, 5, -0.7};
  grid::GridMap grid = plan_.grid();
  grid.map_from_grid = now_from_then * grid.map_from_grid;
  const auto found = alignEdits(edits, segmentRooms(grid).storey, {});
  ASSERT_TRUE(found);
  EXPECT_LT(minus(*found, now_from_then).norm(), 0.2);
}

TEST_F(RoomEditsOfPlan, TwoSignsAreEnoughAndAnotherPlaceIsRefused) {
  RoomEdits edits = anchoredTo({{{Kind::rename, "Library", {{2, 4}}}}, {}, {}}, rooms_.storey,
                               {{"213", {2.1, 2}}, {"215", {4.7, 2}}});
  const geometry::Se2 now_from_then{3, 4, -1};
  grid::GridMap grid = plan_.grid();
  grid.map_from_grid = now_from_then * grid.map_from_grid;
  const Segmentation again = segmentRooms(grid);
  const auto found = alignEdits(edits, again.storey,
                                {{"213", now_from_then * Eigen::Vector2d(2.1, 2)},
                                 {"215", now_from_then * Eigen::Vector2d(4.7, 2)},
                                 {"217", {0, 0}}});
  ASSERT_TRUE(found);
  EXPECT_LT(minus(*found, now_from_then).norm(), 1e-6);
  PaintedPlan other(2, 30);
  other.room(0, 0, 2, 30);
  EXPECT_FALSE(alignEdits(edits, segmentRooms(other.grid()).storey, {})) << "an edit file of another building";
  EXPECT_FALSE(alignEdits(edits, {}, {}));
}

TEST(UniqueSigns, leaveOutWhatHangsTwice) {
  const auto unique = uniqueSigns(
      {{"0:1", "213", {1, 2}, {0, 1}}, {"0:2", "Storage", {3, 2}, {0, 1}}, {"0:3", "Storage", {5, 2}, {0, 1}}});
  ASSERT_EQ(unique.size(), 1U);
  EXPECT_EQ(unique.begin()->first, "213");
}

}  // namespace
}  // namespace omnimapper::building::room_edits_test

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/building/RoomsOfCells.h>
#include <omnimapper/building/Segmentation.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "PaintedPlan.h"

namespace omnimapper::building::rooms_file_test {
namespace {

class RoomsFile : public ::testing::Test {
 protected:
  std::string put(const std::string& text) const {
    std::ofstream(folder_ / "rooms.json") << text;
    return folder_ / "rooms.json";
  }
  std::string refusal(const std::string& text) const {
    try {
      readRooms(put(text));
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      return error.what();
    }
    return "";
  }
  testing::ScratchFolder folder_;
};

TEST_F(RoomsFile, whatWasWrittenIsReadBack) {
  Building building{{segmentRooms(corridorWithRooms(0.05, 0.3).grid()).storey}};
  auto& room = building.storeys[0].rooms[1];
  room.split_from = 1;
  room.name = "Café \"Nord\"";
  room.name_confidence = 0.9;
  room.kind = "kitchen";
  room.kind_confidence = 0.75;
  room.why = {{NameEvidence::Source::sign, "sign \"213\"", 0.9}, {NameEvidence::Source::contents, "stove", 0.75}};
  room.anchor = Anchor{{2, 17}, {1.5, -2.25, 0.125}};
  UnseenRoom unseen;
  unseen.name = "118";
  unseen.door = {3, 4};
  unseen.seen_from = 1;
  building.storeys[0].unseen = {unseen};
  const std::string text = encodeRooms(building, {7, 9});
  EXPECT_EQ(encodeRooms(readRooms(put(text)), {7, 9}), text);
  const auto document = decodeRooms(text, "test");
  EXPECT_EQ(document.gone, std::vector<int>({7, 9}));
  const Room& read = document.building.storeys[0].rooms[1];
  EXPECT_EQ(read.name, room.name);
  EXPECT_EQ(read.anchor->frame, (base::KeyFrameId{2, 17}));
  EXPECT_EQ(read.anchor->map_from_frame.yaw, 0.125);
}

TEST_F(RoomsFile, documentHasTheSchemaItsVersionAndPositionsOfDoors) {
  const auto json = nlohmann::json::parse(encodeRooms({{segmentRooms(twoRooms().grid()).storey}}));
  EXPECT_EQ(json["schema"], "omnimapper-rooms");
  EXPECT_EQ(json["version"], 1);
  const auto& storey = json["building"]["storeys"][0];
  EXPECT_EQ(storey["rooms"].size(), 2U);
  EXPECT_EQ(storey["rooms"][0]["neighbours"], nlohmann::json::array({2}));
  EXPECT_NEAR(storey["doors"][0]["position"][0].get<double>(), 4.05, 0.1);
}

TEST_F(RoomsFile, eachDefectIsNamed) {
  const std::string good = encodeRooms({{segmentRooms(twoRooms().grid()).storey}});
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(refusal(good), "");
  EXPECT_NE(refusal("").find("is no document of rooms"), std::string::npos);
  EXPECT_NE(refusal("[]").find("is no document of rooms"), std::string::npos);
  EXPECT_NE(refusal(changed("\"version\": 1", "\"version\": 2")).find("another version"), std::string::npos);
  EXPECT_NE(refusal(changed("\"outline\"", "\"inline\"")).find("is damaged"), std::string::npos);
  EXPECT_NE(refusal(changed("\"next_room\": 3", "\"next_room\": 1")).find("impossible"), std::string::npos);
  EXPECT_NE(refusal(changed("\"next_room\": 3", "\"next_room\": 2000000000")).find("impossible"), std::string::npos);
  EXPECT_NE(refusal(changed("\"evidence\": []", "\"evidence\": [{\"source\": \"oracle\"}]")).find("unknown source"),
            std::string::npos);
  EXPECT_NE(refusal(changed("\"centre\"", "\"anchor\": {\"key_frame\": \"7\", \"pose\": [0, 0, 0]}, \"centre\""))
                .find("'7' is no key frame"),
            std::string::npos);
  EXPECT_NE(refusal(changed("\"next_door\": 2", "\"next_door\": 0")).find("impossible"), std::string::npos);
  EXPECT_NE(refusal(changed("\"holes\": []", "\"holes\": [[]]")).find("fewer than 3 corners"), std::string::npos);
  EXPECT_NE(refusal(changed("\"holes\": []", "\"holes\": [[[0, 0], [1, 1]]]")).find("fewer than 3 corners"),
            std::string::npos);
  EXPECT_NE(refusal(changed("\"from\": [", "\"from\": [1e7, 2], \"old\": [")).find("too far"), std::string::npos);
  EXPECT_NE(refusal(changed("\"centre\"", "\"anchor\": {\"key_frame\": \"0:7\", \"pose\": [1e300, 0, 0]}, \"centre\""))
                .find("too far"),
            std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)).find("rooms.json"), std::string::npos);
}

TEST_F(RoomsFile, outlinesHaveThreeCornersAndIdsBeginAtOneAlsoWithoutRooms) {
  auto json = nlohmann::json::parse(encodeRooms({{segmentRooms(twoRooms().grid()).storey}}));
  auto& storey = json["building"]["storeys"][0];
  storey["rooms"][0]["outline"] = nlohmann::json::array();
  EXPECT_NE(refusal(json.dump()).find("fewer than 3 corners"), std::string::npos);
  storey["rooms"] = storey["doors"] = nlohmann::json::array();
  EXPECT_EQ(refusal(json.dump()), "");
  storey["next_room"] = 0;
  EXPECT_NE(refusal(json.dump()).find("impossible"), std::string::npos);
}

TEST_F(RoomsFile, aRoomOfOneCellIsReadBack) {
  PaintedPlan plan(4, 4, 1);
  plan.room(1, 1, 2, 2);
  const Storey storey = segmentRooms(plan.grid()).storey;
  ASSERT_EQ(storey.rooms.size(), 1U);
  EXPECT_EQ(refusal(encodeRooms({{storey}})), "");
  EXPECT_NEAR(geometry::area(storey.rooms[0].outline), 1, 1e-9) << "the corners of the cell";
}

TEST(RoomsOfCells, loopsWithoutCornersCoverNoCell) {
  const grid::GridMap grid = twoRooms().grid();
  Storey storey = segmentRooms(grid).storey;
  const auto before = roomsOfCells(storey, grid);
  storey.rooms[1].outline.clear();
  storey.rooms[0].holes.emplace_back();
  const auto after = roomsOfCells(storey, grid);
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_EQ(after[i], before[i] == 2 ? 0 : before[i]);
}

}  // namespace
}  // namespace omnimapper::building::rooms_file_test

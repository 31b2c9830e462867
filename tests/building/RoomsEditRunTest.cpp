#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/building/RoomsEditRun.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/building/Segmentation.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "PaintedPlan.h"

namespace omnimapper::building::rooms_edit_run_test {
namespace {

/// A folder with the grid of two rooms and their rooms.json.
class RoomsEditRun : public ::testing::Test {
 protected:
  RoomsEditRun() {
    const grid::GridMap grid = twoRooms().grid();
    std::ofstream pgm(folder_ / "grid.pgm", std::ios::binary);
    pgm << "P5\n" << grid.columns << " " << grid.rows << "\n255\n";
    for (int row = grid.rows - 1; row >= 0; --row)
      for (int column = 0; column < grid.columns; ++column)
        pgm << static_cast<char>(grid.at({column, row}) == grid::GridCell::free       ? 254
                                 : grid.at({column, row}) == grid::GridCell::occupied ? 0
                                                                                      : 205);
    std::ofstream(folder_ / "grid.yaml") << "image: grid.pgm\nresolution: 0.05\norigin: [" << grid.map_from_grid.x
                                         << ", " << grid.map_from_grid.y
                                         << ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    std::ofstream(folder_ / "rooms.json") << encodeRooms({{segmentRooms(grid).storey}});
  }
  RoomsEditResult edit(const std::vector<std::string>& words) const { return runRoomsEdit({folder_.path(), words}); }
  RoomsDocument document() const { return {readRooms(folder_ / "rooms.json"), {}, readEdits(folder_ / "edits.json")}; }
  std::string refusal(const std::vector<std::string>& words) const {
    try {
      edit(words);
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::command_line);
      return error.what();
    }
    return "";
  }
  testing::ScratchFolder folder_;
};

TEST_F(RoomsEditRun, EditsChangeTheFilesAndAreKept) {
  EXPECT_NE(edit({"rename", "1", "kitchen"}).text.find("rename to 'kitchen'"), std::string::npos);
  edit({"rename", "room 2", "study"});
  edit({"split", "1", "0", "1", "3"});
  const auto now = document();
  EXPECT_EQ(now.edits.edits.size(), 3U);
  EXPECT_EQ(now.edits.outlines.size(), 3U);
  EXPECT_EQ(now.building.storeys[0].rooms.size(), 3U);
  EXPECT_EQ(nameOf(*roomAt(now.building.storeys[0], {3, 1})), "kitchen");
  for (const char* name : {"rooms.png", "plan.svg"}) EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  edit({"merge", "kitchen", "study"});
  EXPECT_EQ(document().building.storeys[0].rooms.size(), 2U);
}

TEST_F(RoomsEditRun, WhatIsNoEditIsRefusedAndChangesNothing) {
  EXPECT_NE(refusal({}).find("rename ROOM NAME"), std::string::npos);
  EXPECT_NE(refusal({"rename", "1"}).find("rename ROOM NAME"), std::string::npos);
  EXPECT_NE(refusal({"rename", "attic", "x"}).find("no room is called 'attic'"), std::string::npos);
  EXPECT_NE(refusal({"rename", "1", "\x1b[2J"}).find("control characters"), std::string::npos);
  EXPECT_NE(refusal({"split", "1", "0", "x", "3"}).find("'x' is not a coordinate"), std::string::npos);
  EXPECT_NE(refusal({"split", "1", "1", "1", "1.5"}).find("does not cut"), std::string::npos);
  EXPECT_NE(refusal({"split", "1", "0", "2e7", "3"}).find("'2e7' is not a coordinate"), std::string::npos);
  EXPECT_NE(refusal({"move-door", "1", "0", "0", "1e200", "0"}).find("not a coordinate"), std::string::npos);
  EXPECT_NE(refusal({"move-door", "1", "0", "0", "900000", "0"}).find("20 m wide"), std::string::npos);
  EXPECT_NE(refusal({"move-door", "7", "1", "1", "1", "2"}).find("no door 7"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "edits.json"));
}

TEST_F(RoomsEditRun, TheFolderOfAYamlFileIsThatOfItsMap) {
  const auto folderOf = [](const std::string& given) { return editedFolder({given, {}}); };
  EXPECT_EQ(folderOf(folder_.path()), folder_.path());
  EXPECT_EQ(folderOf(folder_ / "grid.yaml"), folder_.path());
  EXPECT_EQ(folderOf("grid.yaml"), ".");
  runRoomsEdit({folder_ / "grid.yaml", {"rename", "1", "kitchen"}});
  EXPECT_EQ(document().building.storeys[0].rooms[0].name, "kitchen");
}

TEST_F(RoomsEditRun, WhatCouldNotBeReadAgainIsNotWritten) {
  std::stringstream before;
  before << std::ifstream(folder_ / "rooms.json").rdbuf();
  auto json = nlohmann::ordered_json::parse(before.str());
  for (auto& room : json["building"]["storeys"][0]["rooms"]) {
    room["area_m2"] = 1e308;
    room["openness"] = 2;
  }
  std::ofstream(folder_ / "rooms.json") << json;
  // The mean openness of both rooms overflows.
  try {
    edit({"merge", "1", "2"});
    FAIL() << "it was written";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("the rooms after merge"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "edits.json"));
  EXPECT_EQ(readRooms(folder_ / "rooms.json").storeys[0].rooms.size(), 2U);
}

}  // namespace
}  // namespace omnimapper::building::rooms_edit_run_test

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/building/RoomsRun.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

#include "PaintedPlan.h"

namespace omnimapper::building::rooms_run_test {
namespace {

namespace fs = std::filesystem;

class RoomsRun : public ::testing::Test {
 protected:
  void putYaml(const std::string& resolution = "0.05", const std::string& image = "map.pgm") const {
    std::ofstream(folder_ / "map.yaml") << "image: " << image << "\nresolution: " << resolution
                                        << "\norigin: [0, 0, 0]\nnegate: 0\n";
  }
  void putImage(const grid::GridMap& grid) const {
    std::ofstream out(folder_ / "map.pgm", std::ios::binary);
    out << "P5\n" << grid.columns << " " << grid.rows << "\n255\n";
    for (int y = grid.rows - 1; y >= 0; --y)
      for (int x = 0; x < grid.columns; ++x) out.put("\xcd\xfe\x00"[static_cast<int>(grid.at({x, y}))]);
  }
  RoomsResult run(const std::string& earlier = "") const {
    return runRooms({folder_ / "map.yaml", folder_ / "out", earlier});
  }
  void expectRefusal(base::ExitCode code, const std::string& words) const {
    try {
      run();
      ADD_FAILURE() << "not refused: " << words;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  testing::ScratchFolder folder_;
};

TEST_F(RoomsRun, writesItsFilesAndASummary) {
  putYaml();
  putImage(corridorWithRooms().grid());
  const RoomsResult result = run();
  EXPECT_NE(result.text.find("4 rooms, 3 doors"), std::string::npos) << result.text;
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(readRooms(folder_ / "out/rooms.json").storeys.front().rooms.size(), 4U);
  for (const char* name : {"out/rooms.png", "out/plan.svg"}) EXPECT_GT(fs::file_size(folder_ / name), 500U) << name;
}

TEST_F(RoomsRun, continuesTheNumbersOfAnEarlierMapInTheSameFolder) {
  putYaml();
  putImage(corridorWithRooms().grid());
  run();
  const auto before = readRooms(folder_ / "out/rooms.json");
  const RoomsResult result = run(folder_ / "out/rooms.json");
  EXPECT_NE(result.text.find("4 rooms as before, 0 new, gone: -"), std::string::npos) << result.text;
  EXPECT_EQ(encodeRooms(readRooms(folder_ / "out/rooms.json")), encodeRooms(before));
}

TEST_F(RoomsRun, refusesWhatShowsNoRoomAndSaysWhatToDo) {
  expectRefusal(base::ExitCode::unreadable_input, "map.yaml");
  putYaml();
  expectRefusal(base::ExitCode::unreadable_input, "map.pgm");
  putImage(PaintedPlan(4, 4).grid());
  expectRefusal(base::ExitCode::nothing_to_map, "no free cell");
  putImage(twoRooms().grid());
  putYaml("0.002");
  expectRefusal(base::ExitCode::nothing_to_map, "Is \"resolution\" right?");
  std::ofstream(folder_ / "map.pgm") << "P5\n20000 20000\n255\n";
  expectRefusal(base::ExitCode::unreadable_input, "truncated");
}

TEST_F(RoomsRun, warnsOfCellsThatHideDoorsAndOfAMapWithoutWalls) {
  putImage(PaintedPlan(4, 4).free(0, 0, 4, 4).grid());
  putYaml("0.5");
  const auto warnings = run().warnings;
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("0.5 m"), std::string::npos);
  EXPECT_NE(warnings[1].find("no cell is occupied"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::building::rooms_run_test

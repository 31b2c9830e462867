#include <gtest/gtest.h>
#include <omnimapper/query/MapGrid.h>

#include "HandMadeMap.h"

namespace omnimapper::query::map_grid_test {
namespace {

class MapGridFiles : public ::testing::Test {
 protected:
  std::string refusal(const std::string& yaml, const std::string& pgm) const {
    putFile(folder_ / "grid.yaml", yaml);
    putFile(folder_ / "grid.pgm", pgm);
    return refusal();
  }
  std::string refusal() const {
    return refusalOf([&] { readGrid(folder_.path()); }, base::ExitCode::unreadable_input);
  }
  testing::ScratchFolder folder_;
  const std::string yaml_ = "image: grid.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\n";
  const std::string pgm_ = std::string("P5\n2 1\n255\n") + std::string("\xfe\x00", 2);
};

TEST_F(MapGridFiles, RowZeroIsAtTheSmallestY) {
  putGrid(folder_.path(), {"#.", "?."}, "0.5");
  const GridMap grid = readGrid(folder_.path());
  EXPECT_EQ(grid.columns, 2);
  EXPECT_EQ(grid.at({0, 1}), GridCell::occupied);
  EXPECT_EQ(grid.at({0, 0}), GridCell::unknown);
  EXPECT_EQ(grid.at({1, 0}), GridCell::free);
  EXPECT_EQ(grid.at({2, 0}), GridCell::unknown) << "beyond the grid";
  EXPECT_EQ(grid.cellOf({0.6, 0.4}), Eigen::Vector2i(1, 0));
  EXPECT_EQ(grid.middleOf({1, 0}), Eigen::Vector2d(0.75, 0.25));
  EXPECT_FALSE(grid.contains(grid.cellOf({1e300, -1e300})));
}

TEST_F(MapGridFiles, WhatOthersWriteDifferentlyIsRead) {
  ASSERT_EQ(refusal("# a comment\nimage: \"grid.pgm\"\r\nresolution: 5e-1 # m\norigin: [-1, 2, 0]\n", pgm_), "");
  EXPECT_EQ(readGrid(folder_.path()).map_from_grid.translation(), Eigen::Vector2d(-1, 2));
  ASSERT_EQ(refusal(yaml_, "P5 # one\n# two\n2 1 # three\n255\n" + std::string("\xfe\x00", 2)), "");
  EXPECT_EQ(readGrid(folder_.path()).at({0, 0}), GridCell::free);
}

TEST_F(MapGridFiles, EachDefectIsNamedWithFileAndRemedy) {
  EXPECT_NE(refusal().find("grid.yaml: is missing"), std::string::npos);
  const auto says = [&](const std::string& yaml, const std::string& pgm, const std::string& words) {
    const std::string said = refusal(yaml, pgm);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("GridOutput"), std::string::npos) << said;
  };
  says("", pgm_, "lacks the key \"resolution\"");
  says("image: grid.pgm\nresolution: nan\norigin: [0, 0, 0]\n", pgm_, "\"resolution\" is not a number");
  says("image: grid.pgm\nresolution: 0\norigin: [0, 0, 0]\n", pgm_, "\"resolution\" is not a number");
  says("image: grid.pgm\nresolution: 0.5\norigin: [0, 0, 1]\n", pgm_, "rotated");
  says("image: grid.pgm\nresolution: 0.5\norigin: 7\n", pgm_, "\"origin\" is not a list");
  says("image: grid.pgm\nresolution: 0.5\norigin: [\n", pgm_, "\"origin\" is no");
  says(std::string(1 << 17, ':'), pgm_, "longer");
  says(yaml_ + "mode: other\n", pgm_, "\"mode\" is none of");
  says(yaml_ + "free_thresh: 0.7\noccupied_thresh: 0.6\n", pgm_, "\"free_thresh\" is above");
  says(yaml_, "P2\n2 1\n255\n0 0", "is not a binary PGM");
  says(yaml_, "", "is not a binary PGM");
  says(yaml_, "P5", "no header");
  says(yaml_, "P5\n2 -1\n255\n..", "no header");
  says(yaml_, "P5\n0 0\n255\n", "no header");
  says(yaml_, "P5\n2 1\n65535\n....", "no header");
  says(yaml_, "P5\n100000 100000\n255\n..", "more than 400000000");
  says(yaml_, "P5\n999999999999999999999 9\n255\n..", "no header");
  says(yaml_, "P5\n3 3\n255\n..", "is truncated");
  putFile(folder_ / "grid.yaml", "image: elsewhere.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n");
  EXPECT_NE(refusal().find("elsewhere.pgm"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::query::map_grid_test

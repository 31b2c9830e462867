#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/grid/GridMap.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>

namespace omnimapper::grid::grid_map_test {
namespace {

class GridMapFiles : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  GridMap read(const std::string& yaml) const {
    put("map.yaml", yaml);
    return readGridMap(folder_ / "map.yaml");
  }
  std::string pgm(const std::string& levels) const {
    return "P5\n" + std::to_string(levels.size()) + " 1\n255\n" + levels;
  }
  std::vector<GridCell> cells(const std::string& levels, const std::string& keys) const {
    put("map.pgm", pgm(levels));
    return read("image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n" + keys).cells;
  }
  testing::ScratchFolder folder_;
  static constexpr GridCell kUnknown = GridCell::unknown, kFree = GridCell::free, kOccupied = GridCell::occupied;
};

// 205 of 255 is occupied with probability 0.196078, just above the threshold of map_server.
TEST_F(GridMapFiles, levelsMeanWhatTheyMeanToMapServer) {
  const std::string levels("\xfe\xcd\x00\x64\x65", 5);  // 254, 205, 0, 100, 101
  EXPECT_EQ(cells(levels, ""), (std::vector<GridCell>{kFree, kUnknown, kOccupied, kUnknown, kUnknown}));
  EXPECT_EQ(cells(levels, "free_thresh: 0.25\n")[1], kFree);
  EXPECT_EQ(cells(levels, "negate: 1\n"), (std::vector<GridCell>{kOccupied, kOccupied, kFree, kUnknown, kUnknown}));
  EXPECT_EQ(cells(levels, "mode: raw\n"), (std::vector<GridCell>{kUnknown, kUnknown, kFree, kOccupied, kUnknown}));
}

TEST_F(GridMapFiles, aGridMayBeTurned) {
  put("map.pgm", pgm(std::string("\xfe\xfe", 2)));
  const GridMap grid = read("image: map.pgm\nresolution: 1\norigin: [3, 4, 1.5707963267948966]\n");
  EXPECT_TRUE(grid.middleOf({1, 0}).isApprox(Eigen::Vector2d(2.5, 5.5)));
  EXPECT_EQ(grid.cellOf({2.5, 5.5}), Eigen::Vector2i(1, 0));
}

TEST_F(GridMapFiles, aPngIsReadAsAPgm) {
  draw::Image picture(2, 2, {254, 254, 254});
  picture.at(1, 0) = {0, 0, 0};
  put("map.png", draw::encodePng(picture));
  const GridMap grid = read("image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\n");
  EXPECT_EQ(grid.at({1, 1}), kOccupied) << "row 0 is the lowest";
  EXPECT_EQ(grid.at({1, 0}), kFree);
}

TEST_F(GridMapFiles, aDamagedPngIsNamed) {
  draw::Image picture(2, 2, {254, 254, 254});
  for (const std::size_t size : {5U, 24U, 40U}) {
    put("map.png", draw::encodePng(picture).substr(0, size));
    try {
      read("image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\n");
      ADD_FAILURE() << size << " bytes were read";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find("map.png"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace omnimapper::grid::grid_map_test

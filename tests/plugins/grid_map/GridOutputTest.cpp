#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/derived/GridPicture.h>
#include <omnimapper/derived/MapServer.h>
#include <omnimapper/derived/ScaleBar.h>
#include <omnimapper/derived/ScanGrid.h>
#include <omnimapper/testing/BoxWorld.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>

#include "grid_map/GridOutput.h"
#include "report/CloudPicture.h"

namespace grid_output_test {
namespace {

using namespace box_world;
using derived::Cell;
using derived::ScanGrid;

constexpr double kResolution = 0.05;

Cell cellAt(const ScanGrid& grid, double x, double y) {
  return grid.at(static_cast<int>(std::floor((x - grid.min_x) / grid.resolution)),
                 static_cast<int>(std::floor((y - grid.min_y) / grid.resolution)));
}

void expectRoom(const ScanGrid& grid) {
  int occupied = 0, free = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.min_x + (column + 0.5) * grid.resolution, y = grid.min_y + (row + 0.5) * grid.resolution;
      if (grid.at(column, row) == Cell::occupied) {
        ++occupied;
        EXPECT_LT(distanceToWalls(x, y), 0.75 * grid.resolution) << "occupied at " << x << " " << y;
      } else if (grid.at(column, row) == Cell::free) {
        ++free;
        EXPECT_TRUE(x > -1 - grid.resolution && x < 3 + grid.resolution && y > -1 - grid.resolution &&
                    y < 2 + grid.resolution)
            << "free outside of the room at " << x << " " << y;
      }
    }
  }
  // The walls are 14 m and 1.6 m long, the floor is 12 m^2 less the pillar.
  EXPECT_GT(occupied * grid.resolution, 0.8 * 14);
  EXPECT_GT(free * grid.resolution * grid.resolution, 0.9 * 11.84);
  EXPECT_EQ(cellAt(grid, 1, 0), Cell::free);
  EXPECT_EQ(cellAt(grid, 2.2, 1.2), Cell::unknown) << "inside of the pillar";
  EXPECT_EQ(cellAt(grid, 2.2, -0.2), Cell::free) << "the pillar's mirror image";
}

TEST(ScanGrid, occupiedCellsLieOnTheWallsAndTheFloorIsFree) {
  const auto grid = derived::buildScanGrid(boxRun().map, {});
  ASSERT_TRUE(grid);
  EXPECT_DOUBLE_EQ(grid->resolution, kResolution);
  expectRoom(*grid);
}

TEST(ScanGrid, aScannerUpsideDownSeesTheSameRoom) {
  const auto grid = derived::buildScanGrid(boxRun(CPose3D(0.2, 0.1, 0.3, -0.3, 0, M_PI)).map, {});
  ASSERT_TRUE(grid);
  expectRoom(*grid);
}

TEST(ScanGrid, marginIsUnknownAndAsWideAsAsked) {
  derived::ScanGridOptions options;
  options.margin = 0.3;
  const auto grid = derived::buildScanGrid(boxRun().map, options);
  ASSERT_TRUE(grid);
  EXPECT_NEAR(grid->min_x, -1.3, 2 * kResolution);
  EXPECT_NEAR(grid->maxX(), 3.3, 2 * kResolution);
  EXPECT_NEAR(grid->min_y, -1.3, 2 * kResolution);
  EXPECT_NEAR(grid->maxY(), 2.3, 2 * kResolution);
  for (int column = 0; column < grid->columns; ++column) {
    for (int row = 0; row < 6; ++row) EXPECT_EQ(grid->at(column, row), Cell::unknown);
  }
}

TEST(ScanGrid, aBeamBeyondTheRangeLimitClearsButMarksNoWall) {
  derived::ScanGridOptions options;
  options.max_range = 0.7;
  const auto grid = derived::buildScanGrid(boxRun().map, options);
  ASSERT_TRUE(grid);
  EXPECT_LT(grid->maxX(), 2.6);
  int free = 0;
  for (const Cell cell : grid->cells) free += cell == Cell::free;
  EXPECT_GT(free, 100);
}

TEST(ScanGrid, aReadingAtTheSensorsLimitIsNoWall) {
  RunRecord run;
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->maxRange = 2;
  scan->aperture = 0.5f;
  scan->resizeScan(51);
  for (std::size_t i = 0; i < 51; ++i) {
    scan->setScanRange(i, i < 25 ? 1.0f : 2.0f);
    scan->setScanRangeValidity(i, true);
  }
  map::KeyFrame frame;
  frame.observations.push_back(scan);
  run.map.key_frames.insert(frame);
  const auto grid = derived::buildScanGrid(run.map, {});
  ASSERT_TRUE(grid);
  EXPECT_EQ(cellAt(*grid, std::cos(-0.125), std::sin(-0.125)), Cell::occupied);
  EXPECT_EQ(cellAt(*grid, 1.5 * std::cos(0.125), 1.5 * std::sin(0.125)), Cell::free);
  for (int row = 0; row < grid->rows; ++row) {
    for (int column = 0; column < grid->columns; ++column) {
      const double x = grid->min_x + column * kResolution, y = grid->min_y + row * kResolution;
      EXPECT_FALSE(grid->at(column, row) == Cell::occupied && std::hypot(x, y) > 1.2) << x << " " << y;
    }
  }
}

TEST(ScanGrid, aTooLargeExtentGetsCoarserCells) {
  derived::ScanGridOptions options;
  options.max_cells = 2500;  // 4 x 3 m and 0.5 m around in cells of 0.05 m are over 8000, of 0.1 m 2184
  const auto grid = derived::buildScanGrid(boxRun().map, options);
  ASSERT_TRUE(grid);
  EXPECT_DOUBLE_EQ(grid->resolution, 0.1);
  const std::string yaml = derived::encodeMapServerYaml(*grid, "grid.pgm", kResolution);
  EXPECT_NE(yaml.find("# Warning: cells of 0.05 m were requested"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("resolution: 0.1\n"), std::string::npos) << yaml;
}

TEST(ScanGrid, withoutAValidBeamThereIsNoGrid) {
  EXPECT_FALSE(derived::buildScanGrid({}, {}));
  RunRecord run = boxRun();
  clearObservations(run);
  EXPECT_FALSE(derived::buildScanGrid(run.map, {}));
  auto blind = mrpt::obs::CObservation2DRangeScan::Create();
  blind->resizeScan(3);
  for (std::size_t i = 0; i < 3; ++i) blind->setScanRangeValidity(i, false);
  run.map.key_frames.edit({0, 0}).observations.push_back(blind);
  EXPECT_FALSE(derived::buildScanGrid(run.map, {}));
}

TEST(ScanGrid, aScanThatLooksAtTheFloorIsLeftOut) {
  EXPECT_FALSE(derived::buildScanGrid(boxRun(CPose3D(0.2, 0, 0.3, 0, 0.6, 0)).map, {}));
}

/// The value of the pixel at a place of the map, read from the two files as map_server reads them.
struct MapServerMap {
  int columns = 0, rows = 0;
  double resolution = 0, origin_x = 0, origin_y = 0;
  std::string pixels;

  explicit MapServerMap(const std::string& folder) {
    const std::string yaml = contentOf(folder + "/grid.yaml"), pgm = contentOf(folder + "/grid.pgm");
    resolution = numberAfter(yaml, "resolution: ");
    std::size_t at = 0;
    origin_x = numberAfter(yaml, "origin: [", at);
    origin_y = numberAfter(yaml, ", ", at);
    std::istringstream header(pgm);
    std::string magic;
    int levels;
    header >> magic >> columns >> rows >> levels;
    EXPECT_EQ(magic, "P5");
    EXPECT_EQ(levels, 255);
    pixels = pgm.substr(static_cast<std::size_t>(header.tellg()) + 1);
    EXPECT_EQ(pixels.size(), static_cast<std::size_t>(columns) * rows);
  }
  int at(double x, double y) const {
    const int column = static_cast<int>((x - origin_x) / resolution),
              row_up = static_cast<int>((y - origin_y) / resolution);
    return static_cast<unsigned char>(pixels[static_cast<std::size_t>(rows - 1 - row_up) * columns + column]);
  }
};

TEST(GridOutput, mapServerFindsFreeWallAndUnknownWhereTheyAre) {
  omnimapper::testing::ScratchFolder folder;
  plugins::GridOutput({}, contextFor(folder.path())).finish(boxRun().view());
  const MapServerMap map(folder.path());
  EXPECT_DOUBLE_EQ(map.resolution, kResolution);
  EXPECT_EQ(map.at(1, 0), 254);
  EXPECT_EQ(map.at(2.2, 1.2), 205) << "the pillar is in the upper part";
  EXPECT_EQ(map.at(2.2, -0.2), 254) << "and not in the lower";
  EXPECT_EQ(map.at(-1.3, -1.3), 205);
  int walls = 0;
  for (double x = -0.9; x < 2.9; x += 0.1) walls += std::min(map.at(x, -1.02), map.at(x, -0.98)) == 0;
  EXPECT_GT(walls, 30);
  const std::string yaml = contentOf(folder / "grid.yaml");
  for (const char* line :
       {"image: grid.pgm\n", "negate: 0\n", "occupied_thresh: 0.65\n", "free_thresh: 0.196\n", "mode: trinary\n"}) {
    EXPECT_NE(yaml.find(line), std::string::npos) << line << " is missing in\n" << yaml;
  }
}

TEST(GridOutput, thePngIsTheSamePictureInCrispColours) {
  omnimapper::testing::ScratchFolder folder;
  plugins::GridOutput({}, contextFor(folder.path())).finish(boxRun().view());
  const MapServerMap map(folder.path());
  mrpt::img::CImage png;
  ASSERT_TRUE(png.loadFromFile(folder / "grid.png", 0));
  ASSERT_EQ(static_cast<int>(png.getWidth()), map.columns);
  ASSERT_EQ(static_cast<int>(png.getHeight()), map.rows);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.columns; ++x) {
      const int grey = png.at<std::uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y));
      const int level = static_cast<unsigned char>(map.pixels[static_cast<std::size_t>(y) * map.columns + x]);
      EXPECT_TRUE(level == 254 ? grey == 255
                  : level == 0 ? grey < 64
                               : grey > 200 && grey < 250)
          << "pixel " << x << " " << y << " is " << grey << " for " << level;
    }
  }
}

TEST(GridOutput, aMapWithoutScansGivesNoFile) {
  omnimapper::testing::ScratchFolder folder;
  RunRecord run = boxRun();
  clearObservations(run);
  plugins::GridOutput({}, contextFor(folder.path())).finish(run.view());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(GridPicture, pixelsAreRegisteredWithTheMapAtEveryScale) {
  const auto grid = derived::buildScanGrid(boxRun().map, {});
  ASSERT_TRUE(grid);
  for (const int side : {30, 100, 700}) {
    const auto picture = derived::drawGridToSize(*grid, side);
    EXPECT_NEAR(std::max(picture.image.width, picture.image.height), side, 0.45 * side);
    for (const auto& [x, y, green] :
         {std::tuple{1.0, 0.0, 255}, std::tuple{2.2, -0.2, 255}, std::tuple{-1.4, 2.4, 231}}) {
      const auto pixel = picture.pixelOf(x, y);
      const auto index = static_cast<std::size_t>(pixel.y) * picture.image.width + static_cast<std::size_t>(pixel.x);
      EXPECT_EQ(picture.image.palette[picture.image.pixels[index]].g, green) << x << " " << y << " at side " << side;
    }
  }
}

TEST(GridPicture, aWallOneCellWideStaysBlackAndClosedAtEveryScale) {
  ScanGrid grid;
  grid.columns = grid.rows = 300;
  grid.resolution = 0.1;
  grid.cells.assign(300 * 300, Cell::free);
  for (int x = 0; x < 300; ++x) grid.cells[static_cast<std::size_t>(151) * 300 + x] = Cell::occupied;
  grid.cells[20 * 300 + 20] = Cell::occupied;
  for (const int side : {300, 150, 100, 60}) {
    const auto picture = derived::drawGridToSize(grid, side);
    const auto& image = picture.image;
    ASSERT_EQ(image.width, side);
    const auto row = static_cast<int>(picture.pixelOf(0, 15.15).y);
    for (int x = 0; x < side; ++x) EXPECT_LT(image.palette[image.pixels[row * side + x]].g, 40) << x << " of " << side;
    for (const int beside : {row - 1, row + 1}) EXPECT_EQ(image.palette[image.pixels[beside * side + side / 2]].g, 255);
    const auto dot = picture.pixelOf(2.05, 2.05);
    const auto grey = image.palette[image.pixels[static_cast<int>(dot.y) * side + static_cast<int>(dot.x)]].g;
    EXPECT_LT(grey, 255);
    EXPECT_EQ(grey < 40, side == 300) << "a single cell is not as black as a wall";
  }
}

TEST(ScaleBar, isRoundAndAboutASixthOfThePicture) {
  for (const auto& [width, length] :
       {std::pair{6.0, 1.0}, {11.9, 1.0}, {12.1, 2.0}, {31.0, 5.0}, {75.0, 10.0}, {0.9, 0.1}, {1300.0, 200.0}}) {
    EXPECT_NEAR(derived::scaleBarLength(width), length, 1e-9 * length) << width;
  }
}

TEST(GridPicture, theCornersOfARoomThatStandsAslantAreInThePicture) {
  ScanGrid grid;
  grid.columns = grid.rows = 201;
  grid.resolution = 0.05;
  grid.cells.assign(201 * 201, Cell::unknown);
  for (int row = 0; row < 201; ++row) {
    const int half = 90 - std::abs(row - 100);  // a square standing on its corner, with ten unknown cells around it
    if (half >= 0) std::fill_n(grid.cells.begin() + row * 201 + 100 - half, 2 * half + 1, Cell::free);
  }
  const auto room = derived::focused(grid, {});
  EXPECT_NEAR(room.min_x, 0.05 * (10 - 0.03 * 181), 0.06);
  EXPECT_NEAR(room.maxX(), 0.05 * (191 + 0.03 * 181), 0.06);
}

TEST(GridPicture, aStrayBeamDoesNotMakeTheBuildingSmall) {
  // A room of 100 x 100 cells with one beam of 400 cells through its window.
  ScanGrid grid;
  grid.columns = 500;
  grid.rows = 100;
  grid.resolution = 0.1;
  grid.min_x = -10;
  grid.cells.assign(500 * 100, Cell::unknown);
  for (int row = 0; row < 100; ++row) std::fill_n(grid.cells.begin() + row * 500, 100, Cell::free);
  std::fill_n(grid.cells.begin() + 50 * 500, 500, Cell::free);
  const auto room = derived::focused(grid, {});
  EXPECT_NEAR(room.min_x, -10 - 0.03 * 46.5, 0.15) << "a margin beyond the grid";
  EXPECT_NEAR(room.min_y, -0.06 * 46.5, 0.15) << "room for the scale bar";
  EXPECT_EQ(cellAt(room, -10.1, 5.05), Cell::unknown);
  EXPECT_LT(room.maxX(), 40 - 1.5);
  EXPECT_GT(room.maxX(), 0);
  EXPECT_EQ(room.cells.size(), static_cast<std::size_t>(room.columns) * room.rows);
  EXPECT_EQ(cellAt(room, -5.05, 5.05), Cell::free);
  const auto with_place = derived::focused(grid, {{39.95, 5, 0}});
  EXPECT_NEAR(with_place.maxX(), 40 + 1.5, 0.15);
}

// Two red points above each other with a blue one between them, a green one beside them, and a ceiling above all.
TEST(CloudPicture, showsTheHighestPointBelowTheCeilingInItsColour) {
  map::Map map;
  map::KeyFrame frame;
  const auto point = [](double x, double y, double z, draw::Rgb colour) {
    using map::CloudPoint;
    return CloudPoint{CloudPoint::millimetres(static_cast<float>(x)),
                      CloudPoint::millimetres(static_cast<float>(y)),
                      CloudPoint::millimetres(static_cast<float>(z)),
                      colour.r,
                      colour.g,
                      colour.b};
  };
  constexpr draw::Rgb kRed{255, 0, 0}, kGreen{0, 255, 0}, kBlue{0, 0, 255}, kWhite{255, 255, 255};
  frame.cloud = {point(2, 1, -1, kRed), point(2, 1, -0.5, kBlue), point(4, 1, -0.2, kGreen), point(2, 1, 1.5, kWhite),
                 point(4, 1, 1.5, kWhite)};
  map.key_frames.insert(frame);
  const auto picture = plugins::cloudPicture(map, {{0, 0, 0}}, 400);
  ASSERT_TRUE(picture);
  const auto colourAt = [&](double x, double y) {
    const auto at = picture->pixelOf(x, y);
    return picture->image.palette[picture->image.pixels[static_cast<std::size_t>(at.y) * picture->image.width +
                                                        static_cast<std::size_t>(at.x)]];
  };
  EXPECT_EQ(colourAt(2, 1).b, 255) << "the blue one is over the red one";
  EXPECT_EQ(colourAt(2, 1).r, 0);
  EXPECT_EQ(colourAt(4, 1).g, 255);
  EXPECT_EQ(colourAt(3, 1).r, colourAt(0, 0).r) << "paper";
  EXPECT_FALSE(plugins::cloudPicture(map::Map(), {}, 400)) << "nothing to show";
}

}  // namespace
}  // namespace grid_output_test

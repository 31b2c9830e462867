#include <gtest/gtest.h>
#include <omnimapper/grid/OccupancyGrid.h>
#include <omnimapper/grid/ScanTracer.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace scan_tracer_test {
namespace {

using namespace omnimapper::grid;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;
using Place = std::pair<std::int64_t, std::int64_t>;

/// The votes of a window that are not 0.
std::map<Place, int> votesIn(VoteWindow& window) {
  std::map<Place, int> votes;
  window.takeRows([&](std::int64_t tile_x, std::int64_t tile_y, int row, const std::int8_t* row_votes) {
    for (int x = 0; x < VoteWindow::kTileSide; ++x) {
      if (row_votes[x] != 0)
        votes[{tile_x * VoteWindow::kTileSide + x, tile_y * VoteWindow::kTileSide + row}] = row_votes[x];
    }
  });
  return votes;
}

CObservation2DRangeScan scanOf(const std::vector<float>& ranges, float aperture) {
  CObservation2DRangeScan scan;
  scan.aperture = aperture;
  scan.maxRange = 10;
  scan.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.setScanRange(i, ranges[i]);
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

std::map<Place, int> votesOf(const CObservation2DRangeScan& scan, const CPose3D& map_from_sensor = {},
                             double resolution = 1, double max_range = 30) {
  return votesIn(ScanTracer(max_range).trace(scan, map_from_sensor, resolution));
}

const CPose3D kMiddleOfCell(0.5, 0.5, 0, 0, 0, 0);

TEST(VoteWindow, aLineIsACellForEachColumnAndNoneFarFromIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(1, 299);
  VoteWindow window;
  for (int i = 0; i < 500; ++i) {
    window.moveTo({-100, -50, 199, 249});
    const double x0 = coordinate(random), y0 = coordinate(random);
    const double reach = std::pow(10, coordinate(random) / 100 - 2), angle = coordinate(random);
    const double x1 = std::min(std::max(x0 + reach * std::cos(angle), 1.0), 299.0);
    const double y1 = std::min(std::max(y0 + reach * std::sin(angle), 1.0), 299.0);
    window.voteLine(x0, y0, x1, y1, 1);
    const auto left = window.minX(), low = window.minY();
    const auto votes = votesIn(window);
    const double columns = std::abs(std::floor(x1) - std::floor(x0)), rows = std::abs(std::floor(y1) - std::floor(y0));
    EXPECT_GE(static_cast<double>(votes.size()), std::max(columns, rows) + 1 - 1e-9);
    EXPECT_LE(static_cast<double>(votes.size()), std::max(columns, rows) + 3);
    for (const auto& [place, vote] : votes) {
      const double x = static_cast<double>(place.first - left) + 0.5 - x0, dx = x1 - x0;
      const double y = static_cast<double>(place.second - low) + 0.5 - y0, dy = y1 - y0;
      double nearest = 1e9;
      for (const double along : {0.0, 1.0, x / dx, y / dy}) {
        const double t = std::clamp(along, 0.0, 1.0);
        nearest = std::min(nearest, std::max(std::abs(x - t * dx), std::abs(y - t * dy)));
      }
      EXPECT_LE(nearest, 0.5 + 1e-6) << "the line does not meet that cell";
    }
    EXPECT_EQ(votes.count({left + static_cast<int>(x0), low + static_cast<int>(y0)}), 1u);
    EXPECT_EQ(votes.count({left + static_cast<int>(x1), low + static_cast<int>(y1)}), 1u);
  }
}

TEST(OccupancyGrid, sumsAreExactHoweverManyVotes) {
  OccupancyGrid grid;
  VoteWindow window;
  const auto change = [&](int times, bool in) {
    for (int i = 0; i < times; ++i) {
      window.moveTo({-3, 70, 5, 75});
      window.voteCell(static_cast<double>(-3 - window.minX()), static_cast<double>(70 - window.minY()), 9);
      in ? grid.add(window) : grid.takeOut(window);
    }
  };
  change(20000, true);
  ASSERT_EQ(grid.tiles().count({-1, 1}), 1u);
  const auto& tile = *grid.tiles().at({-1, 1});
  EXPECT_EQ(tile.at(61, 6), 180000);
  EXPECT_EQ(tile.at(62, 6), 0);
  const auto box = grid.bounds();
  EXPECT_EQ(box.min_x, -3);
  EXPECT_EQ(box.max_x, -3);
  EXPECT_EQ(box.min_y, 70);
  EXPECT_EQ(box.max_y, 70);
  change(19999, false);
  EXPECT_EQ(tile.at(61, 6), 9);
  change(1, false);
  EXPECT_LT(grid.bounds().max_x, grid.bounds().min_x);
}

TEST(ScanTracer, aBeamPassesTheCellsBeforeItsEndAndHitsThatOne) {
  const auto votes = votesOf(scanOf({3}, 0), kMiddleOfCell);
  const std::map<Place, int> expected{
      {{0, 0}, kPassVote}, {{1, 0}, kPassVote}, {{2, 0}, kPassVote}, {{3, 0}, kHitVote}};
  EXPECT_EQ(votes, expected);
}

TEST(ScanTracer, beamsAtTheLimitClearAndInvalidOnesSayNothing) {
  EXPECT_EQ(votesOf(scanOf({10}, 0), kMiddleOfCell), votesOf(scanOf({12}, 0), kMiddleOfCell));
  for (const auto& [place, vote] : votesOf(scanOf({10}, 0), kMiddleOfCell)) EXPECT_EQ(vote, kPassVote);
  EXPECT_EQ(votesOf(scanOf({10}, 0), kMiddleOfCell).size(), 11u);
  EXPECT_EQ(votesOf(scanOf({8}, 0), kMiddleOfCell, 1, 2).size(), 3u) << "cut at the option's range";
  const std::map<Place, int> own_cell{{{0, 0}, kPassVote}};  // nothing stands where the sensor is
  for (const float odd : {0.0f, -1.0f, std::nanf(""), INFINITY}) {
    EXPECT_EQ(votesOf(scanOf({odd}, 0), kMiddleOfCell), own_cell) << odd;
  }
  auto invalid = scanOf({3}, 0);
  invalid.setScanRangeValidity(0, false);
  EXPECT_EQ(votesOf(invalid, kMiddleOfCell), own_cell);
  EXPECT_EQ(votesOf(scanOf({}, 0), kMiddleOfCell), own_cell);
}

TEST(ScanTracer, aBeamWithoutAnEchoClearsOnlyBesideOthersWithoutOne) {
  const auto quarter = static_cast<float>(M_PI / 2);
  const auto farthest = [&](const std::vector<float>& ranges) {
    int cells = 0;
    for (const auto& [place, vote] : votesOf(scanOf(ranges, quarter), kMiddleOfCell))
      cells = std::max<int>({cells, std::abs(static_cast<int>(place.first)), std::abs(static_cast<int>(place.second))});
    return cells;
  };
  EXPECT_LT(farthest({3, 3, 3, 10, 3, 3, 3}), 5) << "one met something dark or a mirror";
  EXPECT_LT(farthest({3, 3, 10, 10, 3, 3, 3}), 5);
  EXPECT_GT(farthest({3, 3, 10, 10, 10, 3, 3}), 8) << "an open door";
  EXPECT_GT(farthest({10, 10, 10, 3, 3, 3, 3}), 6);
}

TEST(ScanTracer, beamsOfATiltedLaserOnTheFloorClearAndHitNothing) {
  auto scan = scanOf({1, 3}, 0.02F);
  scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0.3, 0, std::asin(0.1), 0);  // meets the floor at 3 m
  const auto votes = votesOf(scan, kMiddleOfCell);
  const auto hits = std::count_if(votes.begin(), votes.end(), [](const auto& one) { return one.second == kHitVote; });
  EXPECT_EQ(hits, 1);
  EXPECT_EQ(votes.at({1, 0}), kHitVote);
  EXPECT_EQ(votes.at({3, 0}), kPassVote);
}

TEST(ScanTracer, oneScanVotesOnceForACellHoweverManyBeamsMeetIt) {
  const auto votes = votesOf(scanOf(std::vector<float>(181, 3), static_cast<float>(M_PI)), kMiddleOfCell);
  int hits = 0;
  for (const auto& [place, vote] : votes) {
    EXPECT_TRUE(vote == kHitVote || vote == kPassVote) << vote;
    hits += vote == kHitVote;
  }
  EXPECT_GE(hits, 7);
  EXPECT_EQ(votes.at({0, 0}), kPassVote);
}

TEST(ScanTracer, aScannerUpsideDownOrTheOtherWayRoundSeesTheMirrorImage) {
  // A wall on the left only.
  const auto scan = scanOf({8, 7, 6, 5, 4}, 1);
  auto left_to_right = scan;
  left_to_right.rightToLeft = false;
  const CPose3D upside_down(0.5, 0.5, 0, 0, 0, M_PI);
  const auto upright = votesOf(scan, kMiddleOfCell), turned = votesOf(scan, upside_down);
  EXPECT_NE(upright, turned);
  EXPECT_EQ(votesOf(left_to_right, kMiddleOfCell), turned);
  EXPECT_EQ(votesOf(left_to_right, upside_down), upright);
  EXPECT_EQ(votesOf(scan, CPose3D(0.5, 0.5, 0, M_PI, 0, 0)).count({-3, -2}), 1u) << "looking back, its left is below";
}

TEST(ScanTracer, aWallInFrontIsNoRowOfDots) {
  // Ends 0.175 m apart on an arc of 10 m, in cells of 0.05 m.
  const auto scan = scanOf({9.9f, 9.9f, 9.9f}, static_cast<float>(2 * M_PI / 180));
  int wall = 0;
  for (const auto& [place, vote] : votesOf(scan, {}, 0.05)) wall += vote > 0;
  EXPECT_GE(wall, 7);
  // Between ends that are twice as far apart there may be a gap, which the beams do not measure.
  int dots = 0;
  for (const auto& [place, vote] : votesOf(scanOf({9.9f, 9.9f}, static_cast<float>(2 * M_PI / 180)), {}, 0.05)) {
    dots += vote > 0;
  }
  EXPECT_EQ(dots, 2);
}

TEST(ScanTracer, betweenAnObjectAndTheWallBehindItThereIsNoWall) {
  for (const auto& [place, vote] : votesOf(scanOf({2, 2, 4, 4}, 0.06f), {}, 0.05)) {
    const double range = std::hypot(place.first + 0.5, place.second + 0.5) * 0.05;
    EXPECT_TRUE(vote < 0 || std::abs(range - 2) < 0.06 || std::abs(range - 4) < 0.06) << range;
  }
}

/// The scan of a wall along y = -0.77 m, from (0, 0), as a robot in a corridor sees it at ever smaller angles.
CObservation2DRangeScan corridorScan() {
  std::vector<float> ranges;
  for (int i = 0; i < 181; ++i) {
    const double angle = (-90 + i) * M_PI / 180;
    ranges.push_back(angle < 0 ? static_cast<float>(std::min(0.77 / std::sin(-angle), 11.0)) : 11.0f);
  }
  return scanOf(ranges, static_cast<float>(M_PI));
}

TEST(ScanTracer, aWallSeenAtGrazingAnglesIsNotClearedBetweenItsHits) {
  constexpr double kResolution = 0.05;
  ScanTracer tracer(30);
  OccupancyGrid grid;
  // The robot drives along: each cell of the wall is met at many angles.
  for (double x = 0; x < 10; x += 0.6) grid.add(tracer.trace(corridorScan(), CPose3D(x, 0, 0, 0, 0, 0), kResolution));
  const auto row = static_cast<std::int64_t>(std::floor(-0.77 / kResolution));
  int occupied = 0, cleared = 0;
  for (std::int64_t column = 0; column < 200; ++column) {
    const auto tile = grid.tiles().find({column >> 6, row >> 6});
    ASSERT_NE(tile, grid.tiles().end());
    const int odds = tile->second->at(static_cast<int>(column & 63), static_cast<int>(row & 63));
    occupied += odds > kOccupiedAbove;
    cleared += odds < kFreeBelow;
  }
  EXPECT_GT(occupied, 190);
  EXPECT_LT(cleared, 6);
}

TEST(ScanTracer, whoStoodThereAndWentIsForgotten) {
  ScanTracer tracer(30);
  OccupancyGrid grid;
  grid.add(tracer.trace(scanOf({3}, 0), kMiddleOfCell, 1));
  EXPECT_GT(grid.tiles().at({0, 0})->at(3, 0), kOccupiedAbove);
  for (int i = 0; i < 2; ++i) grid.add(tracer.trace(scanOf({6}, 0), kMiddleOfCell, 1));
  EXPECT_GE(grid.tiles().at({0, 0})->at(3, 0), 0) << "two beams that pass do not clear a hit";
  for (int i = 0; i < 2; ++i) grid.add(tracer.trace(scanOf({6}, 0), kMiddleOfCell, 1));
  EXPECT_LT(grid.tiles().at({0, 0})->at(3, 0), kFreeBelow);
  EXPECT_GT(grid.tiles().at({0, 0})->at(6, 0), kOccupiedAbove);
}

}  // namespace
}  // namespace scan_tracer_test

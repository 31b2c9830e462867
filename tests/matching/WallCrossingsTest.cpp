#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/WallCrossings.h>

#include <cmath>
#include <limits>

#include "Beams.h"

namespace omnimapper::matching::wall_crossings_test {
namespace {

using mrpt::math::TPose2D;

// A wall at x = 2, from y = -1 to 1, seen from `pose`.
MapScan wallSeenFrom(const TPose2D& pose) {
  MapScan placed{pose, {}};
  for (int i = 0; i <= 40; ++i) {
    const double y = -1 + 0.05 * i, dx = 2 - pose.x, dy = y - pose.y, c = std::cos(pose.phi), s = std::sin(pose.phi);
    placed.scan.hits.emplace_back(c * dx + s * dy, c * dy - s * dx);
  }
  return placed;
}

std::vector<MapScan> wallSeenFiveTimes() {
  return {wallSeenFrom({0, 0, 0}), wallSeenFrom({0.3, 0.2, 0.4}), wallSeenFrom({0.1, -0.2, -0.1}),
          wallSeenFrom({0.1, 0.1, 0.1}), wallSeenFrom({-0.3, 0.1, 0})};
}

TEST(WallCrossings, BeamsThatEndOnTheWallDoNotCrossIt) {
  for (const auto& sum : crossedWalls(wallSeenFiveTimes()).scans) {
    EXPECT_EQ(sum.beams, 41u);
    EXPECT_EQ(sum.crossed, 0u);
  }
}

TEST(WallCrossings, BeamsThroughTheWallAreCounted) {
  auto scans = wallSeenFiveTimes();
  // Two beams go straight through it; one ends 0.4 m behind it, one passes beside it, and one has no end.
  scans.push_back({{0, 0, 0}, {{{4, 0}, {5, 0.5F}, {2.4F, 0}, {4, 3.2F}}, {{5, -0.5F}}}});
  const auto sums = crossedWalls(scans).scans;
  EXPECT_EQ(sums.back().beams, 4u);
  EXPECT_EQ(sums.back().crossed, 2u);
}

TEST(WallCrossings, WhereManyScansPassThereIsNoWall) {
  auto scans = wallSeenFiveTimes();
  // With the third of these, 3 of 8 scans pass through the wall.
  for (int i = 0; i < 3; ++i) scans.push_back({{0, 0, 0}, {{{4, 0}}, {}}});
  EXPECT_EQ(crossedWalls(scans).scans.back().crossed, 0u);
  scans.pop_back();
  EXPECT_EQ(crossedWalls(scans).scans.back().crossed, 1u);
}

TEST(WallCrossings, WhatFewerScansSawIsNoWall) {
  auto scans = wallSeenFiveTimes();
  EXPECT_GT(crossedWalls(scans).walls, 15u) << "2 m in cells of 10 cm";
  scans.pop_back();
  EXPECT_EQ(crossedWalls(scans).walls, 0u);
  scans.push_back({{0, 0, 0}, {{{4, 0}}, {}}});
  EXPECT_EQ(crossedWalls(scans).scans.back().crossed, 0u);
}

TEST(WallCrossings, WhoLooksAlongAWallDoesNotCrossIt) {
  auto scans = wallSeenFiveTimes();
  scans.push_back({{2, -3, M_PI / 2}, {{{6, 0}}, {}}});
  EXPECT_EQ(crossedWalls(scans).scans.back().crossed, 0u);
}

TEST(WallCrossings, StepsOfTheTrackThroughTheWallAreTold) {
  const std::vector<TrackStep> track{
      {{1.5, 0}, {2.5, 0}}, {{1.5, 0}, {1.9, 0}}, {{1.5, 2}, {2.5, 2}}, {{2.5, 0}, {1.5, 0.4}}, {{1, 0}, {1, 0}}};
  EXPECT_EQ(crossedWalls(wallSeenFiveTimes(), {}, track).steps, (std::vector<bool>{true, false, false, true, false}));
}

TEST(WallCrossings, InATrueMapNoScanCrossesAndInABentOneThoseThatAreOffDo) {
  const auto plan = testing::FloorPlan::ring();
  std::vector<MapScan> scans;
  for (int i = 0; i < 20; ++i) {
    const TPose2D pose(0.1 * i, 0.02 * i, 0.05 * i);
    scans.push_back({pose, beamsFrom(plan, pose, 180, 8, 0.01, static_cast<std::uint64_t>(i + 1))});
  }
  const auto share = [](const CrossedWalls& sum) {
    return static_cast<double>(sum.crossed) / static_cast<double>(sum.beams);
  };
  for (const auto& sum : crossedWalls(scans).scans) EXPECT_LT(share(sum), 0.02);
  for (std::size_t i = 16; i < scans.size(); ++i) scans[i].map_from_sensor.y += 1.5;
  const auto sums = crossedWalls(scans).scans;
  for (std::size_t i = 0; i < 20; ++i) {
    if (i < 16) {
      EXPECT_LT(share(sums[i]), 0.1) << i;
    } else {
      EXPECT_GT(share(sums[i]), 0.2) << i;
    }
  }
}

TEST(WallCrossings, WhatIsNotFiniteOrEmptyIsLeftOut) {
  EXPECT_TRUE(crossedWalls({}).scans.empty());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto sums = crossedWalls({{{0, 0, 0}, {{{nan, 0}, {1, nan}}, {{nan, nan}}}}, {{0, 0, 0}, {}}}).scans;
  ASSERT_EQ(sums.size(), 2u);
  EXPECT_EQ(sums.front().beams, 0u);
}

TEST(WallCrossings, AMapTooLargeForTheGridIsRefused) {
  const grid::BeamScan scan{{{1, 0}, {1, 0.1F}}, {}};
  EXPECT_THROW(crossedWalls({{{0, 0, 0}, scan}, {{1e6, 1e6, 0}, scan}}), base::Error);
  EXPECT_THROW(crossedWalls({{{0, 0, 0}, scan}, {{1e300, 1e300, 0}, scan}}), base::Error);
}

}  // namespace
}  // namespace omnimapper::matching::wall_crossings_test

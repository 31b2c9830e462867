#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/grid/HitMissGrid.h>

#include <cmath>

#include "../matching/Beams.h"

namespace omnimapper::grid::beam_grid_test {
namespace {

using mrpt::math::TPose2D;

// One beam along x that ended at 3.07 m, seen five times from the origin.
HitMissGrid oneBeam() {
  static const BeamScan seen{{{3.07F, 0}}, {}};
  return HitMissGrid({5, HitMissGrid::Placed{{0.05, 0.05, 0}, &seen}});
}

TEST(HitMissGrid, ABeamThatEndsOnAWallIsCertain) {
  EXPECT_NEAR(oneBeam().logLikelihood({{{3.07F, 0}}, {}}, {0.05, 0.05, 0}), 0, 1e-9);
  EXPECT_NEAR(oneBeam().logLikelihood({{{2.07F, 0}}, {}}, {1.05, 0.05, 0}), 0, 1e-9) << "from nearer";
}

TEST(HitMissGrid, ABeamThatEndsInFreeSpaceIsClutter) {
  EXPECT_NEAR(oneBeam().logLikelihood({{{1.5F, 0}}, {}}, {0.05, 0.05, 0}), std::log(0.02), 1e-9);
}

TEST(HitMissGrid, ABeamThatEndsWhereNothingIsKnownSaysLittle) {
  EXPECT_NEAR(oneBeam().logLikelihood({{{0, 1.5F}}, {}}, {0.05, 0.05, 0}), std::log(0.3), 1e-9);
}

TEST(HitMissGrid, ABeamThroughAWallIsUnlikely) {
  // Five hits, no passes: open with probability 0.5 / 5.5; what lies behind is not known.
  EXPECT_NEAR(oneBeam().logLikelihood({{{5, 0}}, {}}, {0.05, 0.05, 0}), std::log(0.5 / 5.5 * 0.3), 1e-9);
  EXPECT_NEAR(oneBeam().logLikelihood({{}, {{5, 0}}}, {0.05, 0.05, 0}), std::log(0.5 / 5.5), 1e-9) << "a miss";
  EXPECT_NEAR(oneBeam().logLikelihood({{}, {{3.2F, 0}}}, {0.05, 0.05, 0}), 0, 1e-9) << "within the tolerance";
}

TEST(HitMissGrid, TheMeanIsOverAllBeams) {
  EXPECT_NEAR(oneBeam().logLikelihood({{{3.07F, 0}, {1.5F, 0}}, {{2, 0}}}, {0.05, 0.05, 0}), std::log(0.02) / 3, 1e-9);
  EXPECT_EQ(oneBeam().logLikelihood({}, {0, 0, 0}), 0);
}

TEST(HitMissGrid, TheTruePoseIsLikelierThanThoseAround) {
  const auto plan = testing::FloorPlan::ring();
  std::vector<BeamScan> scans;
  const std::vector<TPose2D> poses{{0, 0, 0}, {0.5, 0.1, 0}, {1, 0, 0.1}, {0.4, 0, -0.2}};
  for (const auto& pose : poses) scans.push_back(matching::beamsFrom(plan, pose));
  std::vector<HitMissGrid::Placed> placed;
  for (std::size_t i = 0; i < poses.size(); ++i) placed.push_back({poses[i], &scans[i]});
  const HitMissGrid grid(placed);
  const TPose2D truth(0.7, 0.05, 0.03);
  const auto scan = matching::beamsFrom(plan, truth);
  const double there = grid.logLikelihood(scan, truth);
  EXPECT_GT(there, -0.2);
  for (const auto& wrong : {TPose2D(1.0, 0.05, 0.03), TPose2D(0.7, 0.35, 0.03), TPose2D(0.7, 0.05, 0.2),
                            TPose2D(0.7, 0.05, 3.17), TPose2D(3, 0, 0.03)}) {
    EXPECT_LT(grid.logLikelihood(scan, wrong), there - 0.1) << wrong;
  }
}

TEST(HitMissGrid, HoldsNothingWithoutScansAndRefusesAMapTooLarge) {
  const HitMissGrid nothing(std::vector<HitMissGrid::Placed>{});
  EXPECT_NEAR(nothing.logLikelihood({{{1, 0}}, {}}, {0, 0, 0}), std::log(0.3), 1e-9);
  BeamModel small;
  small.max_cells = 100;
  const BeamScan scan{{{30, 0}, {0, 30}}, {}};
  EXPECT_THROW(HitMissGrid({{{0, 0, 0}, &scan}}, small), base::Error);
}

}  // namespace
}  // namespace omnimapper::grid::beam_grid_test

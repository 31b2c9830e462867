#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <sstream>

#include "omnimapper/eval/MapQuality.h"

namespace omnimapper::eval {

namespace {

using Eigen::Vector3d;
using surfaces::Surface;
using surfaces::SurfaceClass;
using surfaces::SurfaceSet;

// Upright, from x = `from` to x = `to` [m] at that y, 2 m high, free on the side of lower y.
Surface wall(double from, double to, double y, SurfaceClass is = SurfaceClass::wall) {
  Surface surface;
  surface.is = is;
  surface.plane = {-Vector3d::UnitY(), y};
  surface.parts.push_back({{{from, y, 0}, {to, y, 0}, {to, y, 2}, {from, y, 2}}, {}});
  surface.name = toString(is) + " at " + std::to_string(y);
  return surface;
}

Surface turned(Surface surface) {
  surface.plane = {-surface.plane.normal, -surface.plane.distance};
  return surface;
}

Surface candidate(Surface surface) {
  surface.is_candidate = true;
  return surface;
}

// A true wall 4 m long of which the first `seen` metres were seen.
Surface seenWall(double seen) {
  Surface surface = wall(0, 4, 3);
  surface.seen = surfaces::CellGrid::around(surface.plane, cornersOf(surface), 0.05);
  surface.seen->fill(wall(0, seen, 3).parts[0].outline);
  return surface;
}

SurfaceSet setOf(std::vector<Surface> all) {
  return {"test", std::move(all), {}};
}

}  // namespace

TEST(MapQuality, ATrueMapHasEverythingOnceAndRight) {
  const auto truth = setOf({wall(0, 4, 3), turned(wall(0, 4, 3.3)), wall(5, 6, 3, SurfaceClass::door)});
  const auto quality = judgeMap(truth, truth);
  EXPECT_EQ(quality.sought.size(), 3u);
  EXPECT_EQ(quality.foundOnce(), 3u);
  EXPECT_TRUE(quality.doubles.empty());
  EXPECT_EQ(quality.spurious(), 0u);
  EXPECT_EQ(quality.rightLabels(), 3u);
  EXPECT_NEAR(quality.medianOverlap(), 1, 1e-9);
  EXPECT_NEAR(quality.area.at(SurfaceClass::wall).covered, 16, 1e-9);
}

TEST(MapQuality, TwoThatLieOnEachOtherAreOnePairAndTheWallIsNotThereOnce) {
  const auto quality = judgeMap(setOf({wall(0, 4, 3), wall(1, 4, 3.05)}), setOf({wall(0, 4, 3)}));
  ASSERT_EQ(quality.doubles.size(), 1u);
  EXPECT_EQ(quality.doubles.front(), (std::pair<std::size_t, std::size_t>(0, 1)));
  EXPECT_EQ(quality.found(), 1u);
  EXPECT_EQ(quality.foundOnce(), 0u);
}

TEST(MapQuality, AWallInTwoPiecesIsNotThereOnceThoughNothingIsDoubled) {
  const auto quality = judgeMap(setOf({wall(0, 2.4, 3), wall(2.4, 4, 3)}), setOf({wall(0, 4, 3)}));
  EXPECT_TRUE(quality.doubles.empty());
  EXPECT_EQ(quality.found(), 1u);
  EXPECT_EQ(quality.foundOnce(), 0u);
  EXPECT_NEAR(quality.sought.front().covered, 1, 1e-9);
}

TEST(MapQuality, BothFacesOfAThinWallAreTwo) {
  const auto truth = setOf({wall(0, 4, 3), turned(wall(0, 4, 3.05))});
  EXPECT_TRUE(judgeMap(truth, truth).doubles.empty());
  // One face alone counts for one surface.
  EXPECT_EQ(judgeMap(setOf({wall(0, 4, 3)}), truth).found(), 1u);
}

TEST(MapQuality, TwoTrueSurfacesCloseBehindEachOtherAreNoDouble) {
  const auto truth = setOf({wall(0, 4, 3), wall(1, 2, 2.95, SurfaceClass::door)});
  const auto quality = judgeMap(truth, truth);
  EXPECT_TRUE(quality.doubles.empty());
  EXPECT_EQ(quality.rightLabels(), 2u);
}

TEST(MapQuality, WhatLiesMostlyOnNothingIsSpurious) {
  // One wall lies on the true one with 1.5 of its 4 m; the other is a metre in front of it.
  const auto quality = judgeMap(setOf({wall(2.5, 6.5, 3), wall(0, 4, 2)}), setOf({wall(0, 4, 3)}));
  EXPECT_EQ(quality.spurious(), 2u);
  EXPECT_NEAR(quality.drawn.front().share_on_true, 1.5 / 4, 1e-9);
}

TEST(MapQuality, OnlyWhatWasSeenIsSoughtAndCounts) {
  const auto some = setOf({seenWall(1)});  // a quarter
  EXPECT_TRUE(judgeMap(setOf({}), some).sought.empty());
  const auto most = judgeMap(setOf({wall(0, 3, 3)}), setOf({seenWall(3)}));
  EXPECT_EQ(most.foundOnce(), 1u);
  EXPECT_NEAR(most.medianOverlap(), 1, 1e-9);
  EXPECT_NEAR(most.area.at(SurfaceClass::wall).seen, 6, 1e-9);
  // Drawn beyond what was seen: 3 of 4 m.
  EXPECT_NEAR(judgeMap(setOf({wall(0, 4, 3)}), setOf({seenWall(3)})).medianOverlap(), 0.75, 1e-9);
  EXPECT_TRUE(judgeMap(setOf({}), setOf({seenWall(0)})).area.empty());
}

TEST(MapQuality, ClassesAreHeldAgainstTheTrueOnes) {
  const auto truth = setOf({wall(0, 4, 3), wall(6, 8, 3, SurfaceClass::cabinet)});
  const auto quality = judgeMap(setOf({wall(0, 4, 3), wall(6, 8, 3)}), truth);
  EXPECT_EQ(quality.rightLabels(), 1u);
  EXPECT_EQ(quality.rightOf(SurfaceClass::wall), (std::pair<std::size_t, std::size_t>(1, 2)));
  EXPECT_EQ(quality.labels.at(SurfaceClass::wall).at(SurfaceClass::cabinet), 1u);
}

TEST(MapQuality, AWallAcrossAClosedDoorIsNotTheDoor) {
  const auto truth = setOf({wall(0, 4, 3), wall(1, 2, 2.95, SurfaceClass::door)});
  const auto quality = judgeMap(setOf({wall(0, 4, 3)}), truth);
  EXPECT_EQ(quality.sought.size(), 2u);
  EXPECT_EQ(quality.found(), 1u) << "the wall";
  EXPECT_NEAR(quality.area.at(SurfaceClass::door).covered, 0, 1e-9);
}

TEST(MapQuality, ExamplesAreOfWhatLiesOnTrueSurfaces) {
  const auto map = setOf({wall(0, 4, 3, SurfaceClass::surface), wall(0, 4, 9), candidate(wall(5, 6, 3))});
  const auto examples = examplesOf(judgeMap(map, setOf({wall(0, 4, 3), wall(5, 6, 3, SurfaceClass::door)})), map);
  ASSERT_EQ(examples.size(), 2U);
  EXPECT_EQ(examples[0].is, SurfaceClass::wall);
  EXPECT_NEAR(examples[0].facts.longer, 4, 0.11);
  EXPECT_EQ(examples[1].is, SurfaceClass::door);
}

TEST(MapQuality, APosterIsPartOfItsWall) {
  const auto truth = setOf({wall(0, 4, 3), wall(1, 2, 2.99, SurfaceClass::poster)});
  const auto quality = judgeMap(setOf({wall(0, 4, 3)}), truth);
  EXPECT_EQ(quality.sought.size(), 1u);
  EXPECT_EQ(quality.foundOnce(), 1u);
  EXPECT_EQ(quality.rightLabels(), 1u);
}

TEST(MapQuality, CandidatesAreCountedAndNotJudged) {
  const auto quality =
      judgeMap(setOf({wall(0, 4, 3), candidate(wall(0, 4, 3.02)), candidate(wall(0, 4, 9))}), setOf({wall(0, 4, 3)}));
  EXPECT_EQ(quality.drawn.size(), 1u);
  EXPECT_EQ(quality.foundOnce(), 1u);
  EXPECT_EQ(quality.candidates.size(), 2u);
  EXPECT_EQ(quality.trueCandidates(), 1u);
}

TEST(MapQuality, WhatIsMovedIsNotSoughtAndWhatLiesOnItIsNotSpurious) {
  Surface moved = wall(0, 1, 3, SurfaceClass::object);
  moved.is_moved = true;
  const auto quality = judgeMap(setOf({wall(0, 1, 3)}), setOf({moved}));
  EXPECT_TRUE(quality.sought.empty());
  EXPECT_EQ(quality.spurious(), 0u);
}

TEST(MapQuality, OfAMapWithoutSurfacesNothingIsFoundAndOfAPlaceWithoutAllIsSpurious) {
  const auto none = judgeMap(setOf({}), setOf({wall(0, 4, 3)}));
  EXPECT_EQ(none.found(), 0u);
  EXPECT_EQ(none.sought.size(), 1u);
  EXPECT_FALSE(table(none).empty());
  EXPECT_EQ(judgeMap(setOf({wall(0, 4, 3)}), setOf({})).spurious(), 1u);
}

TEST(MapQuality, ASurfaceThatReachesTooFarIsRefusedByName) {
  try {
    judgeMap(setOf({wall(0, 1e7, 3)}), setOf({wall(0, 4, 3)}));
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("surface 'wall at 3"), std::string::npos) << error.what();
  }
}

TEST(MapQuality, TheReportNamesWhatIsWrong) {
  const testing::ScratchFolder scratch;
  const auto map = setOf({wall(0, 4, 3), wall(1, 4, 3.05), wall(0, 4, 9)}), truth = setOf({wall(0, 4, 3)});
  const auto quality = judgeMap(map, truth);
  saveReport(scratch / "quality", "test", quality, map, truth);
  EXPECT_NE(json(quality, map, truth).find("\"doubled_pairs\": 1"), std::string::npos);
  std::ostringstream plan_text;
  plan_text << std::ifstream(scratch / "quality/plan.svg").rdbuf();
  const std::string plan = plan_text.str();
  EXPECT_NE(plan.find("#dc2626"), std::string::npos);
  EXPECT_NE(plan.find("#2563eb"), std::string::npos);
}

}  // namespace omnimapper::eval

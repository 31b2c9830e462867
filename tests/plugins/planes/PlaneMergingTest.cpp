#include <omnimapper/map/Level.h>
#include <omnimapper/testing/SimulatedLog.h>

#include "SurfaceRun.h"
#include "planes/PlaneExtent.h"
#include "planes/PlaneLandmarkIndex.h"
#include "planes/PlanePayload.h"

namespace omnimapper::plugins::plane_merging_test {
namespace {

using namespace surface_run;

class PlaneMerging : public SurfaceRun {};

// A table in the form of an L: its arms are seen one after the other, then the corner between them.
TEST_F(PlaneMerging, ABoundaryAsSeenHasBaysUntilTheyAreSeen) {
  PlaneLandmarksOptions options;
  options.boundary = PlaneLandmarksOptions::Boundary::seen;
  options.well_seen_under = 89 * geometry::kPi / 180;
  make(options);
  driveTo({});
  see(planesOf({plane({2, 0, 0.7}, {1, 0, 0}, {0, 0.3, 0})}));
  see(planesOf({plane({2.7, 0.5, 0.7}, {0.3, 0, 0}, {0, 0.8, 0})}));
  ASSERT_EQ(active().size(), 1U);
  ASSERT_EQ(shapeOf(active()[0]).surfaces.size(), 1U);
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 1.2 + 0.6 * 1.0, 1e-6);
  see(planesOf({plane({2.2, 0.5, 0.7}, {0.2, 0, 0}, {0, 0.2, 0})}));
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 1.8 + 0.4 * 0.4, 1e-6);
  const auto patches = [&] { return dynamic_cast<const PlanePayload&>(*active()[0].payload).patches.size(); };
  EXPECT_EQ(patches(), 3U);
  see(planesOf({plane({2.2, 0.5, 0.7}, {0.2, 0, 0}, {0, 0.2, 0})}));
  EXPECT_EQ(patches(), 3U) << "nothing new";
  for (int i = 0; i < 30; ++i) {
    const double noise = 0.01 * (i % 3 - 1);
    see(planesOf({plane({2.2 + noise, 0.5, 0.7}, {0.2 + noise, 0, 0}, {0, 0.2 - noise, 0})}));
  }
  EXPECT_EQ(patches(), 3U) << "edges are measured slightly differently each time";
}

// Lines at two heights span a hull in which the plane of a camera lies.
TEST_F(PlaneMerging, ABoundaryAsSeenOfAWallThatLinesHaveShownFirst) {
  PlaneLandmarksOptions options;
  options.boundary = PlaneLandmarksOptions::Boundary::seen;
  make(options);
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}, 0.1));
  see(linesOf({line({3, -2}, {3, 2})}, 1.9));
  see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 1U);
  ASSERT_EQ(shapeOf(active()[0]).surfaces.size(), 1U);
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 2 * 1.6, 0.01);
}

TEST_F(PlaneMerging, TwoTablesOfOneHeightStayTwo) {
  driveTo({});
  see(planesOf({tableTop(2, -1, 0.7), tableTop(2, 1, 0.7)}));
  see(planesOf({tableTop(2, 1, 0.701)}));
  ASSERT_EQ(active().size(), 2U);
  EXPECT_EQ(active()[0].evidence, 1U);
  EXPECT_EQ(active()[1].evidence, 2U);
  EXPECT_EQ(shapeOf(active()[1]).label, "table");
}

TEST_F(PlaneMerging, PartsThatAreFoundToBeOneAreMerged) {
  driveTo({});
  see(planesOf({wallPlane(3, -2, -1), wallPlane(3, 0, 1)}));
  ASSERT_EQ(active().size(), 2U);
  see(planesOf({wallPlane(3, -1.5, 0.5)}));
  EXPECT_EQ(active().size(), 2U);
  solve();
  ASSERT_EQ(active().size(), 1U);
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 3 * 1.6, 0.01);
  EXPECT_EQ(active()[0].evidence, 3U);
  EXPECT_EQ(run_.decisions.back().kind, "merge");
}

// By the covariance of the map the views are two surfaces, because their covariances are far too small.
TEST_F(PlaneMerging, ViewsThatLieOnEachOtherAreOne) {
  PlaneLandmarksOptions options;
  options.plane_sigma = options.plane_angle_sigma = 1e-4;
  make(options);
  driveTo({});
  const auto precise = [](double x) {
    auto seen = wallPlane(x, -1, 1);
    seen.covariance = Vector3d(1e-8, 1e-8, 1e-8).asDiagonal();
    return seen;
  };
  see(planesOf({precise(3)}));
  see(planesOf({precise(3.03)}));
  see(planesOf({precise(3.12)}));
  ASSERT_EQ(active().size(), 3U);
  solve();
  EXPECT_EQ(active().size(), 2U) << "a surface 0.1 m in front of it stays";
}

// Views 6 cm apart: if half of each covers the other, one may be in front of the other; if all of the smaller one does,
// one would hide the other.
TEST_F(PlaneMerging, ViewsThatLieOnEachOtherNearlyEverywhereAreOneEvenFartherApart) {
  PlaneLandmarksOptions options;
  options.plane_sigma = options.plane_angle_sigma = 1e-4;
  make(options);
  driveTo({});
  const auto precise = [](double x, double y0, double y1) {
    auto seen = wallPlane(x, y0, y1);
    seen.covariance = Vector3d(1e-8, 1e-8, 1e-8).asDiagonal();
    return seen;
  };
  see(planesOf({precise(3, -1, 1), precise(3.06, 0, 2)}));
  solve();
  EXPECT_EQ(active().size(), 2U);
  see(planesOf({precise(3.06, 0.2, 2)}));
  see(planesOf({precise(3, -1, 1.9)}));
  solve();
  EXPECT_EQ(active().size(), 1U);
}

TEST_F(PlaneMerging, AtTheEndPartsOfOneWallAreOneAndTwoTablesAreTwo) {
  driveTo({});
  const auto high = [](double y0, double y1) {
    return plane({3, 0.5 * (y0 + y1), 1.1}, {0, -0.5 * (y1 - y0), 0}, {0, 0, 1.1});
  };
  see(planesOf({high(-2, -1), high(0, 1), tableTop(2, -1, 0.7), tableTop(2, 1, 0.7)}));
  solve();
  ASSERT_EQ(active().size(), 4U);
  apply(plugin_->atEnd(run_.view()));
  ASSERT_EQ(active().size(), 3U);
  EXPECT_EQ(shapeOf(active()[0]).surfaces.size(), 2U) << "the part between them was not seen";
}

TEST_F(PlaneMerging, AtTheEndSurfacesAreJudgedAndWhatWasSeenOnceIsACandidate) {
  driveTo({});
  see(planesOf({wallPlane(3, -2, 2), tableTop(2, 1, 0.7)}));
  see(planesOf({wallPlane(3, -2, 2)}));
  apply(plugin_->atEnd(run_.view()));
  ASSERT_EQ(active().size(), 2U);
  EXPECT_EQ(shapeOf(active()[0]).label, "wall");
  EXPECT_FALSE(shapeOf(active()[0]).reason.empty());
  EXPECT_FALSE(shapeOf(active()[0]).is_candidate);
  EXPECT_TRUE(shapeOf(active()[1]).is_candidate);
  EXPECT_EQ(active()[0].evidence, 2U) << "judging is no measurement";
}

// A second end of a run, as when a saved map is continued.
TEST_F(PlaneMerging, WhatAnEndAcceptedStaysAndACandidateIsJudgedAnew) {
  driveTo({});
  see(planesOf({wallPlane(3, -2, 2), tableTop(2, 1, 0.7)}));
  see(planesOf({wallPlane(3, -2, 2)}));
  apply(plugin_->atEnd(run_.view()));
  ASSERT_TRUE(shapeOf(active()[1]).is_candidate);
  for (int i = 1; i < 450; ++i) driveTo({0.001 * i, 0, 0, 0, 0, 0});
  see(planesOf({tableTop(2 - 0.449, 1, 0.7)}));
  EXPECT_FALSE(shapeOf(active()[1]).is_candidate) << "drawn until the next end";
  apply(plugin_->atEnd(run_.view()));
  EXPECT_FALSE(shapeOf(active()[0]).is_candidate) << "by now it would have to be seen four times";
  EXPECT_FALSE(shapeOf(active()[1]).is_candidate);
}

TEST_F(PlaneMerging, WithHullsSurfacesThatLieOnEachOtherAreOneToo) {
  PlaneLandmarksOptions options;
  options.boundary = PlaneLandmarksOptions::Boundary::hull;
  options.plane_sigma = options.plane_angle_sigma = 1e-4;
  make(options);
  driveTo({});
  for (const double x : {3.0, 3.03}) {
    auto seen = wallPlane(x, -1, 1);
    seen.covariance = Vector3d(1e-8, 1e-8, 1e-8).asDiagonal();
    see(planesOf({seen}));
  }
  ASSERT_EQ(active().size(), 2U);
  solve();
  EXPECT_EQ(active().size(), 1U);
}

// Level ground of 800 m by 800 m, as a laser on a mast sees it.
TEST_F(PlaneMerging, OneThatIsTooLargeToBeCountedIsALandmarkAllTheSame) {
  driveTo({});
  for (int i = 0; i < 3; ++i) see(planesOf({plane({0, 0, -1.5}, {400, 0, 0}, {0, 400, 0})}));
  solve();
  apply(plugin_->atEnd(run_.view()));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 3U);
}

// A wall of 6 m, 5 m off, then from 2 m: of its length 2 sqrt(4^2 - 2^2) = 6.93 m lie within 4 m.
TEST_F(PlaneMerging, WhatWasSeenFromAfarIsDrawnUntilItIsSeenFromNear) {
  driveTo({});
  see(planesOf({wallPlane(5, -6, 6)}));
  ASSERT_EQ(active().size(), 1U);
  ASSERT_EQ(shapeOf(active()[0]).surfaces.size(), 1U);
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 12 * 1.6, 0.01);
  driveTo({3, 0, 0, 0, 0, 0});
  see(planesOf({wallPlane(2, -6, 6)}));
  ASSERT_EQ(active().size(), 1U);
  ASSERT_EQ(shapeOf(active()[0]).surfaces.size(), 1U);
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 6.6 * 1.6, 0.3);
}

// 0.5 m before a wall 75 deg from its normal are 1.87 m along it.
TEST_F(PlaneMerging, WhatWasSeenAslantIsNotDrawnBesideWhatWasSeenWell) {
  driveTo({});
  see(planesOf({plane({0.5, 0, 0}, {0, -6, 0}, {0, 0, 0.2})}));
  ASSERT_EQ(active().size(), 1U);
  ASSERT_EQ(shapeOf(active()[0]).surfaces.size(), 1U);
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 2 * 1.866 * 0.4, 0.01);
}

TEST_F(PlaneMerging, AtTheEndWhatIsRougherThanTheRestIsACandidate) {
  driveTo({});
  const auto rough = [](obs::ObservedPlane seen, double roughness) {
    seen.roughness = roughness;
    return seen;
  };
  for (int i = 0; i < 3; ++i) {
    see(planesOf({rough(wallPlane(3, -2, 2), 0.9), rough(wallPlane(2, -3.5, -2.5), 1.6),
                  rough(wallPlane(2, 2.5, 3.5), 1), rough(tableTop(2, 0, 0.7), 1.6)}));
  }
  apply(plugin_->atEnd(run_.view()));
  ASSERT_EQ(active().size(), 4U);
  EXPECT_FALSE(shapeOf(active()[0]).is_candidate);
  EXPECT_TRUE(shapeOf(active()[1]).is_candidate) << "upright, and twice as rough as the wall";
  EXPECT_FALSE(shapeOf(active()[2]).is_candidate);
  EXPECT_FALSE(shapeOf(active()[3]).is_candidate) << "objects on a table make it rough";
}

TEST_F(PlaneMerging, AtTheEndOneTakesInSeveral) {
  driveTo({});
  const auto high = [](double y0, double y1) {
    return plane({3, 0.5 * (y0 + y1), 1.1}, {0, -0.5 * (y1 - y0), 0}, {0, 0, 1.1});
  };
  see(planesOf({high(-3, -2), high(-1, 0), high(1, 2)}));
  see(planesOf({high(-3, -2), high(-1, 0), high(1, 2)}));
  ASSERT_EQ(active().size(), 3U);
  solve();
  apply(plugin_->atEnd(run_.view()));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 6U);
  EXPECT_EQ(factorsOfKind("plane_from_se3"), 6U);
}

TEST_F(PlaneMerging, TheFacesOfAThinWallAreTwo) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  driveTo({6.1, 0, 0, geometry::kPi, 0, 0});
  see(planesOf({wallPlane(3, -1, 1)}));
  solve();
  EXPECT_EQ(active().size(), 2U);
}

TEST_F(PlaneMerging, StretchesOfANewWallSeenAtOnceAreOne) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, -0.3}), line({3, 0.1}, {3, 2})}));
  EXPECT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("line_on_plane"), 2U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 1U);
}

// A handheld camera whose first picture had y up sees a floor 1 m below it, a table and a wall.
TEST_F(PlaneMerging, ClassesAreThoseOfTheLevelFrame) {
  driveTo({});
  const auto place = [](const obs::ObservedPlane& floor) {
    return planesOf(
        {floor, plane({1, -0.27, -0.7}, {0, 0, 0.4}, {0.8, 0, 0}), plane({3, 0.2, 0}, {0, 0, 2}, {0, 1.2, 0})});
  };
  const auto floor = plane({1, -1, 0}, {0, 0, 2}, {2, 0, 0});
  ASSERT_GT(floor.plane_in_sensor.normal.y(), 0);
  see(place(floor));
  see(place(floor));
  see(place(floor));
  ASSERT_EQ(active().size(), 3U);
  run_.map.layers.set(map::Level{map::Level::Source::planes, Vector3d::UnitY(), Eigen::Matrix3d::Zero(), ""});
  apply(plugin_->atEnd(run_.view()));
  EXPECT_EQ(shapeOf(active()[0]).label, "floor") << shapeOf(active()[0]).reason;
  EXPECT_EQ(shapeOf(active()[1]).label, "table") << shapeOf(active()[1]).reason;
  EXPECT_EQ(shapeOf(active()[2]).label, "wall") << shapeOf(active()[2]).reason;
  EXPECT_NEAR(shapeOf(active()[0]).surfaces[0].vertices[0].y(), -1, 1e-6) << "the map is not turned";
}

// The same camera in front of two parts of a wall with a door between them, from 1 m below the camera to 1.2 m above.
class PartsOfAWall : public PlaneMerging, public ::testing::WithParamInterface<std::pair<map::Level, std::size_t>> {};

TEST_P(PartsOfAWall, areOneAtTheEndIfTheyStandUpright) {
  const auto part = [](double z0, double z1) {
    return plane({3, 0.1, 0.5 * (z0 + z1)}, {0, 0, 0.5 * (z1 - z0)}, {0, 1.1, 0});
  };
  driveTo({});
  see(planesOf({plane({1, -1, 0}, {0, 0, 2}, {2, 0, 0}), part(-2, -1), part(0, 1)}));
  ASSERT_EQ(active().size(), 3U);
  run_.map.layers.set(GetParam().first);
  apply(plugin_->atEnd(run_.view()));
  EXPECT_EQ(active().size(), GetParam().second);
}

INSTANTIATE_TEST_SUITE_P(
    Levels, PartsOfAWall,
    ::testing::Values(
        std::pair(map::Level{map::Level::Source::planes, Vector3d::UnitY(), Eigen::Matrix3d::Zero(), ""}, 2U),
        std::pair(map::Level{map::Level::Source::planes, Vector3d::UnitZ(), Eigen::Matrix3d::Zero(), ""}, 3U),
        std::pair(map::Level{}, 3U)));

TEST_F(PlaneMerging, NothingHasAClassWhereUpIsNotKnown) {
  driveTo({});
  see(planesOf({wallPlane(3, -2, 2), tableTop(2, 1, 0.7)}));
  run_.map.layers.set(map::Level{});
  apply(plugin_->atEnd(run_.view()));
  for (const auto& landmark : active()) {
    EXPECT_EQ(shapeOf(landmark).label, "surface");
    EXPECT_EQ(shapeOf(landmark).reason, "which way is up is not known");
  }
}

// Holds for any two outlines, whether or not their heights are known.
TEST(PlaneGaps, TheCheapBoundIsNeverAboveTheGap) {
  testing::Dice dice(7);
  std::size_t apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool is_upright = i % 2 == 0;
    const Vector3d normal = is_upright ? Vector3d(dice.normal(1), dice.normal(1), dice.normal(0.05)).normalized()
                                       : Vector3d(dice.normal(0.3), dice.normal(0.3), 1).normalized();
    const auto cloud = [&](double spread) {
      const Vector3d about(dice.normal(4), dice.normal(4), dice.normal(2));
      std::vector<Vector3d> points;
      for (int k = 0; k < 6; ++k)
        points.push_back(about + Vector3d(dice.normal(spread), dice.normal(spread), dice.normal(spread)));
      return points;
    };
    LandmarkSurface surface;
    surface.plane = Plane3::through(Vector3d(dice.normal(1), dice.normal(1), dice.normal(1)), normal);
    const plane_factors::PlaneAxes axes(surface.plane);
    surface.hull = hullOn(axes, cloud(1));
    Vector2d middle = Vector2d::Zero();
    for (const auto& corner : surface.hull) middle += corner / static_cast<double>(surface.hull.size());
    for (const auto& corner : surface.hull) surface.radius = std::max(surface.radius, (corner - middle).norm());
    surface.middle = axes.inSpace(middle);
    using Heights = LandmarkSurface::Heights;
    surface.heights = i % 4 < 2 ? Heights::known : Heights::unknown;
    const auto points = cloud(0.5);
    Vector3d mean = Vector3d::Zero();
    for (const auto& point : points) mean += point / static_cast<double>(points.size());
    const double gap = gapBetween(surface, points, Heights::known), bound = gapAtLeast(surface, points, mean);
    EXPECT_LE(bound, gap + 1e-9) << i;
    apart += bound > 0;
  }
  EXPECT_GT(apart, 500u) << "the bound is useful";
}

}  // namespace
}  // namespace omnimapper::plugins::plane_merging_test

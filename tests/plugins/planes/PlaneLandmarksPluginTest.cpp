#include <omnimapper/geometry/PlaneTangent.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "SurfaceRun.h"
#include "planes/PlanePayload.h"

namespace omnimapper::plugins::plane_landmarks_plugin_test {
namespace {

using namespace surface_run;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class PlaneLandmarks : public SurfaceRun {};

TEST_F(PlaneLandmarks, AWallSeenByLaserAndCameraIsOne) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 1U);
  EXPECT_EQ(shapeOf(active()[0]).label, "wall");
  EXPECT_TRUE(shapeOf(active()[0]).surfaces.empty()) << "a laser measures no height";
  ASSERT_EQ(shapeOf(active()[0]).lines.size(), 1U);
  see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 0U) << "the camera determines the tilt";
  EXPECT_EQ(factorsOfKind("line_on_plane"), 1U);
  EXPECT_EQ(factorsOfKind("plane_from_se3"), 1U);
  const auto shape = shapeOf(active()[0]);
  ASSERT_EQ(shape.surfaces.size(), 1U);
  EXPECT_NEAR(shape.normal->x(), -1, 1e-3) << "to where the robot is";
  const auto& payload = dynamic_cast<const PlanePayload&>(*active()[0].payload);
  EXPECT_EQ(payload.seen_by.at("laser").lines, 1U);
  EXPECT_EQ(payload.seen_by.at("camera").planes, 1U);
}

TEST_F(PlaneLandmarks, ALineAtASecondHeightDeterminesTheTiltOfAWall) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}, 0.2));
  see(linesOf({line({3, -2}, {3, 2})}, 0.5));
  EXPECT_EQ(factorsOfKind("upright_plane"), 1U) << "0.3 m of height are not enough";
  see(linesOf({line({3.05, -2}, {3.05, 2})}, 1.2));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 0U);
  solve();
  EXPECT_NEAR(shapeOf(active()[0]).normal->z(), 0.05, 0.02) << "it tilts back by 5 cm over 0.85 m";
  see(linesOf({line({3.05, -2}, {3.05, 2})}, 1.25));
  EXPECT_EQ(factorsOfKind("upright_plane"), 0U);
}

TEST_F(PlaneLandmarks, GrowAsMoreOfThemIsSeen) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  driveTo({0.5, 0, 0, 0, 0, 0});
  see(planesOf({wallPlane(2.5, 0, 2)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_NEAR(geometry::area(shapeOf(active()[0]).surfaces[0]), 3 * 1.6, 0.01);
  EXPECT_EQ(active()[0].evidence, 2U);
}

TEST_F(PlaneLandmarks, ALandmarkMetTwiceInAFrameKeepsBothMeasurements) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}));
  see(planesOf({wallPlane(3, -1, -0.2), wallPlane(3, 0.2, 2.5)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 3U);
  EXPECT_EQ(dynamic_cast<const PlanePayload&>(*active()[0].payload).seen_by.at("camera").planes, 2U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 0U);
}

TEST_F(PlaneLandmarks, MoveThePoseThatSeesThemAgain) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1), tableTop(2, 1, 0.7)}));
  driveTo({1.03, 0, 0, 0, 0, 0});
  see(planesOf({wallPlane(2, -1, 1)}));  // the wall says 1.00
  solve();
  EXPECT_NEAR(run_.map.key_frames.back().map_from_base.x(), 1.02, 0.012);
  EXPECT_LT(run_.map.key_frames.back().map_from_base.x(), 1.03);
}

// After a long drive the estimate of the base is 0.9 m off, so that a wall just seen, behind the one that it sees
// again, is nearer to the measurement.
TEST_F(PlaneLandmarks, OneSeenLongAgoIsFoundPastOneThatWasSeenJustNow) {
  driveTo(CPose3D());
  see(planesOf({wallPlane(3, -1, 1)}));
  for (int i = 1; i <= 15; ++i) driveTo(CPose3D(0, -0.8 * i, 0, 0, 0, 0));
  for (int i = 14; i >= 0; --i) driveTo(CPose3D(0, -0.8 * i, 0, 0, 0, 0));
  see(planesOf({wallPlane(4.6, -1, 1)}));
  ASSERT_EQ(active().size(), 2U);
  see(planesOf({wallPlane(3.9, -1, 1)}));
  ASSERT_EQ(active().size(), 2U);
  EXPECT_EQ(active()[0].evidence, 2U);
  EXPECT_EQ(active()[1].evidence, 1U);
}

TEST_F(PlaneLandmarks, WhatIsTooFarOffIsNotMatched) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  see(planesOf({wallPlane(3.3, -1, 1)}));
  EXPECT_EQ(active().size(), 2U);
  EXPECT_EQ(run_.decisions.back().reason, "new: gated out: too far from the nearest");
}

TEST_F(PlaneLandmarks, SmallSurfacesMakeNoLandmark) {
  driveTo({});
  see(linesOf({line({3, 0}, {3, 0.5})}));
  see(planesOf({plane({2, 0, 1}, {0, -0.1, 0}, {0, 0, 0.1})}));
  EXPECT_TRUE(active().empty());
  EXPECT_FALSE(run_.decisions.back().accepted);
}

TEST_F(PlaneLandmarks, BadInputIsLeftOut) {
  driveTo({});
  auto not_finite = wallPlane(3, -1, 1), no_extent = not_finite, no_normal = not_finite, no_covariance = not_finite,
       corner_not_finite = not_finite;
  not_finite.plane_in_sensor.distance = kNan;
  no_extent.outline.vertices.resize(2);
  no_normal.plane_in_sensor.normal.setZero();
  no_covariance.covariance.setConstant(kNan);
  corner_not_finite.outline.vertices[0].x() = kNan;
  see(planesOf({not_finite, no_extent, no_normal, no_covariance, corner_not_finite}));
  auto point = line({3, 0}, {3, 1}), undefined = point;
  point.segment_in_sensor.to = point.segment_in_sensor.from;
  undefined.segment_in_sensor.to.x() = kNan;
  see(linesOf({point, undefined}));
  see(linesOf({}));
  EXPECT_TRUE(active().empty());
  std::set<std::string> reasons;
  for (const auto& decision : run_.decisions) reasons.insert(decision.reason);
  EXPECT_EQ(reasons, (std::set<std::string>{"not finite", "its outline has no area",
                                            "its covariance is singular or not finite", "its ends are one point"}));
  EXPECT_TRUE(run_.graph.factors().empty());
}

// The plane goes through the base, at distance 0, which is a plane like any other here.
TEST_F(PlaneLandmarks, APlaneThroughTheOriginIsAPlane) {
  driveTo({});
  see(planesOf({tableTop(1, 0, 0)}));
  see(planesOf({tableTop(1, 0, 0.002)}));
  solve();
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 2U);
  EXPECT_EQ(shapeOf(active()[0]).label, "floor");
}

// Lines at two heights tilt the wall, the prior holds it upright: the contradiction does not break the solution.
TEST_F(PlaneLandmarks, ContradictoryLinesAreSettled) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}, 0.3));
  see(linesOf({line({3.03, -2}, {3.03, 2})}, 0.5));
  solve();
  ASSERT_EQ(active().size(), 1U);
  EXPECT_LT(std::abs(shapeOf(active()[0]).normal->z()), 0.15);
  EXPECT_TRUE(run_.graph.value(active()[0].variables[0]).allFinite());
}

}  // namespace
}  // namespace omnimapper::plugins::plane_landmarks_plugin_test

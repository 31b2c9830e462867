#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/plugins/PlaneLandmarksPlugin.h>
#include <omnimapper/testing/HandMadeRun.h>
#include <omnimapper/testing/MapperRun.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "landmarks/PlaneFactors.h"
#include "landmarks/PlanePayload.h"
#include "landmarks/SurfaceForm.h"

namespace omnimapper::plugins::plane_landmarks_plugin_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Plane3;
using mrpt::poses::CPose3D;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A rectangle around `middle` with half-axes a and b; the normal is a x b.
obs::ObservedPlane plane(const Vector3d& middle, const Vector3d& a, const Vector3d& b) {
  obs::ObservedPlane seen;
  seen.plane_in_sensor = Plane3::through(middle, a.cross(b).normalized());
  seen.covariance = Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  seen.centroid = middle;
  seen.outline.vertices = {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
  seen.inliers = 1000;
  return seen;
}

/// A wall on x = `x`, facing the origin, from y0 to y1 and as high as a camera sees.
obs::ObservedPlane wallPlane(double x, double y0, double y1) {
  return plane({x, 0.5 * (y0 + y1), 1}, {0, -0.5 * (y1 - y0), 0}, {0, 0, 0.8});
}

/// A table top at that height.
obs::ObservedPlane tableTop(double x, double y, double z) {
  return plane({x, y, z}, {0.4, 0, 0}, {0, 0.3, 0});
}

obs::LaserLine line(const Vector2d& from, const Vector2d& to) {
  obs::LaserLine seen;
  seen.segment_in_sensor = {from, to};
  const Vector2d along = (to - from).normalized();
  Vector2d out(along.y(), -along.x());  // from the sensor to the wall
  if (out.dot(from) < 0) out = -out;
  seen.angle = std::atan2(out.y(), out.x());
  seen.distance = out.dot(from);
  seen.covariance = Vector2d(1e-5, 1e-4).asDiagonal();
  return seen;
}

template <class Observation>
Observation stamped(Observation observation, const std::string& source, double z) {
  observation.source_label = source;
  observation.sensorLabel = source + ".derived";
  observation.sensorPose = CPose3D(0, 0, z, 0, 0, 0);
  return observation;
}

obs::CObservationPlanes planesOf(std::vector<obs::ObservedPlane> planes, double z = 0) {
  obs::CObservationPlanes observation;
  observation.planes = std::move(planes);
  return stamped(observation, "camera", z);
}

obs::CObservationLaserLines linesOf(std::vector<obs::LaserLine> lines, double z = 0.4) {
  obs::CObservationLaserLines observation;
  observation.lines = std::move(lines);
  return stamped(observation, "laser", z);
}

class PlaneLandmarks : public ::testing::Test {
 protected:
  explicit PlaneLandmarks(PlaneLandmarksOptions options = {}) { make(options); }

  void make(const PlaneLandmarksOptions& options) {
    mapper::PluginContext context;
    context.section = "planes";
    context.motion = run_.motion;
    plugin_ = std::make_unique<PlaneLandmarksPlugin>(options, context);
  }
  void driveTo(const CPose3D& map_from_base) {
    const bool is_first = run_.map.key_frames.empty();
    const map::KeyFrame before = is_first ? map::KeyFrame() : run_.map.key_frames.back();
    const map::KeyFrame& frame = run_.addFrame(map_from_base);
    if (!is_first) {
      mrpt::math::CMatrixDouble66 covariance;
      covariance.setDiagonal(6, 1e-4);
      run_.graph.addFactor(mapper::betweenPoses(run_.motion, before.pose, frame.pose,
                                                {map_from_base - before.map_from_base, covariance.asEigen()},
                                                "odometry"));
    }
    run_.uncertainty = mapper::Uncertainty(run_.graph);
  }
  void apply(const mapper::Batch& batch) {
    const auto ids = mapper::apply(batch, {"planes", run_.map.key_frames.back().stamp}, run_.graph, run_.map);
    run_.decisions.insert(run_.decisions.end(), batch.decisions().begin(), batch.decisions().end());
    plugin_->applied(ids);
  }
  void see(const mrpt::obs::CObservation& observation) {
    ASSERT_TRUE(plugin_->wants(observation));
    apply(plugin_->measure(run_.map.key_frames.back(), {observation, nullptr}, run_.view()));
  }
  // As the engine does, with what plugins do after it.
  void solve() {
    graph::solve(run_.graph);
    for (std::size_t i = 0; i < run_.map.key_frames.size(); ++i) {
      auto& frame = run_.map.key_frames.edit(run_.map.key_frames[i].id);
      frame.map_from_base = mapper::poseOf(run_.graph, frame.pose);
    }
    run_.uncertainty = mapper::Uncertainty(run_.graph);
    run_.solves.emplace_back();
    apply(plugin_->afterCommit(run_.map.key_frames.back(), run_.view()).batch);
  }
  std::vector<map::Landmark> active() const {
    std::vector<map::Landmark> found;
    for (const auto& [id, landmark] : run_.map.landmarks)
      if (landmark.state == map::Landmark::State::active) found.push_back(landmark);
    return found;
  }
  map::LandmarkShape shapeOf(const map::Landmark& landmark) const {
    return landmark.payload->shape({run_.graph.value(landmark.variables.front())}, run_.map.key_frames);
  }
  std::size_t factorsOfKind(const std::string& kind) const {
    std::size_t count = 0;
    for (const auto& [id, record] : run_.graph.factors()) count += record.factor->kind() == kind;
    return count;
  }

  testing::HandMadeRun run_;
  std::unique_ptr<PlaneLandmarksPlugin> plugin_;
};

TEST_F(PlaneLandmarks, AWallSeenByLaserAndCameraIsOne) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 1U);
  EXPECT_EQ(shapeOf(active()[0]).label, "wall");
  EXPECT_TRUE(shapeOf(active()[0]).surfaces.empty()) << "a laser tells no height";
  ASSERT_EQ(shapeOf(active()[0]).lines.size(), 1U);
  see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 0U) << "the camera tells how it leans";
  EXPECT_EQ(factorsOfKind("line_on_plane"), 1U);
  EXPECT_EQ(factorsOfKind("plane_from_se3"), 1U);
  const auto shape = shapeOf(active()[0]);
  ASSERT_EQ(shape.surfaces.size(), 1U);
  EXPECT_NEAR(shape.normal->x(), -1, 1e-3) << "to where the robot is";
  const auto& payload = dynamic_cast<const PlanePayload&>(*active()[0].payload);
  EXPECT_EQ(payload.seen_by.at("laser").lines, 1U);
  EXPECT_EQ(payload.seen_by.at("camera").planes, 1U);
}

TEST_F(PlaneLandmarks, ALineOfASecondHeightTellsHowAWallLeans) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}, 0.2));
  see(linesOf({line({3, -2}, {3, 2})}, 0.5));
  EXPECT_EQ(factorsOfKind("upright_plane"), 1U) << "0.3 m of height tell too little";
  see(linesOf({line({3.05, -2}, {3.05, 2})}, 1.2));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 0U);
  solve();
  EXPECT_NEAR(shapeOf(active()[0]).normal->z(), 0.05, 0.02) << "it leans back by 5 cm over 0.85 m";
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

TEST_F(PlaneLandmarks, TwoTablesOfOneHeightStayTwo) {
  driveTo({});
  see(planesOf({tableTop(2, -1, 0.7), tableTop(2, 1, 0.7)}));
  see(planesOf({tableTop(2, 1, 0.701)}));
  ASSERT_EQ(active().size(), 2U);
  EXPECT_EQ(active()[0].evidence, 1U);
  EXPECT_EQ(active()[1].evidence, 2U);
  EXPECT_EQ(shapeOf(active()[1]).label, "table");
}

TEST_F(PlaneLandmarks, PartsThatAreFoundToBeOneAreMerged) {
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

TEST_F(PlaneLandmarks, TheFacesOfAThinWallAreTwo) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  driveTo({6.1, 0, 0, geometry::kPi, 0, 0});
  see(planesOf({wallPlane(3, -1, 1)}));
  solve();
  EXPECT_EQ(active().size(), 2U);
}

TEST_F(PlaneLandmarks, StretchesOfANewWallSeenAtOnceAreOne) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, -0.3}), line({3, 0.1}, {3, 2})}));
  EXPECT_EQ(active().size(), 1U);
  EXPECT_EQ(factorsOfKind("line_on_plane"), 2U);
  EXPECT_EQ(factorsOfKind("upright_plane"), 1U);
}

TEST_F(PlaneLandmarks, ALandmarkMetTwiceInAMomentKeepsBothSightings) {
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

TEST_F(PlaneLandmarks, WhatIsTooFarOffIsNotMatched) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  see(planesOf({wallPlane(3.3, -1, 1)}));
  EXPECT_EQ(active().size(), 2U);
  EXPECT_EQ(run_.decisions.back().reason, "new: gated out: too far from the nearest");
}

TEST_F(PlaneLandmarks, SmallThingsMakeNoLandmark) {
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
  EXPECT_TRUE(run_.graph.factors().empty());
}

// Its distance is 0 from the base: no normal of its own there, but a plane like any other here.
TEST_F(PlaneLandmarks, APlaneThroughTheOriginIsAPlane) {
  driveTo({});
  see(planesOf({tableTop(1, 0, 0)}));
  see(planesOf({tableTop(1, 0, 0.002)}));
  solve();
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 2U);
  EXPECT_EQ(shapeOf(active()[0]).label, "floor");
}

// Lines of two heights lean it, the prior holds it upright: neither breaks the solution.
TEST_F(PlaneLandmarks, ContradictoryLinesAreSettled) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}, 0.3));
  see(linesOf({line({3.03, -2}, {3.03, 2})}, 0.5));
  solve();
  ASSERT_EQ(active().size(), 1U);
  EXPECT_LT(std::abs(shapeOf(active()[0]).normal->z()), 0.15);
  EXPECT_TRUE(run_.graph.value(active()[0].variables[0]).allFinite());
}

TEST_F(PlaneLandmarks, GoOnInAMapThatIsContinued) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  make({});
  plugin_->restore(nullptr, run_.view());
  see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 2U);
}

TEST_F(PlaneLandmarks, PayloadComesBackFromAFile) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}));
  see(planesOf({wallPlane(3, -1, 1)}));
  const auto& payload = dynamic_cast<const PlanePayload&>(*active()[0].payload);
  std::ostringstream bytes, again;
  payload.write(bytes);
  map::PayloadRegistry registry;
  PlanePayload::addTo(registry);
  const auto back = registry.read("plane", bytes.str());
  back->write(again);
  EXPECT_EQ(again.str(), bytes.str());
  const std::string future = "\x09" + bytes.str().substr(1);
  EXPECT_THROW(registry.read("plane", future), base::Error);
}

class WallLandmarks : public PlaneLandmarks {
 protected:
  static PlaneLandmarksOptions walls() {
    PlaneLandmarksOptions options;
    options.form = PlaneLandmarksOptions::Form::wall;
    return options;
  }
  WallLandmarks() : PlaneLandmarks(walls()) {}
};

TEST_F(WallLandmarks, HaveTwoDegreesOfFreedomAndNoPrior) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2}), line({-2, 3}, {2, 3})}));
  driveTo({0.5, 0, 0, 0.2, 0, 0});
  const geometry::Se2 base_from_map = inverse(geometry::Se2{0.5, 0, 0.2});
  see(linesOf({line(base_from_map * Vector2d(3, -1), base_from_map * Vector2d(3, 2.5))}));
  ASSERT_EQ(active().size(), 2U);
  EXPECT_EQ(run_.graph.variable(active()[0].variables[0]).kind->kind(), "wall");
  EXPECT_EQ(factorsOfKind("wall_from_se2"), 3U);
  EXPECT_EQ(run_.graph.factors().size(), 4U);  // and the odometry
  const auto [from, to] = shapeOf(active()[0]).lines.at(0);
  EXPECT_NEAR((to - from).norm(), 4.5, 1e-6);
  EXPECT_FALSE(plugin_->wants(planesOf({})));
}

TEST_F(WallLandmarks, AreNotForMapsInSpace) {
  run_.motion = mapper::Motion::spatial;
  EXPECT_THROW(make(walls()), base::Error);
}

// A drive through a simulated box: its four walls, and a trajectory better than odometry's.
TEST(WallLandmarksDrive, MapTheFourWallsOfABox) {
  const std::string ini = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = walls
solve_every         = 10
[perception]
extractors = lines
[odometry]
class = OdometryPlugin
[lines]
class = LaserLineExtractor
[walls]
class = PlaneLandmarksPlugin
form  = wall
)";
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  const testing::SimulatedLog log(options);
  const auto engine = testing::makeEngine(ini);
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  std::size_t walls = 0;
  for (const auto& [id, landmark] : view.map.landmarks)
    walls += landmark.state == map::Landmark::State::active && landmark.evidence > 5;
  EXPECT_EQ(walls, 4U);
  EXPECT_LT(testing::trajectoryError(view, log), 0.03);
}

}  // namespace
}  // namespace omnimapper::plugins::plane_landmarks_plugin_test

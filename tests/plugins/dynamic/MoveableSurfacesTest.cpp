// Moved walls, tables and points, with other factors on them: those that hold them upright, relations, planes and
// lines.
#include <gtest/gtest.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/plane_factors/PlaneVariable.h>

#include "MoveableRoom.h"
#include "dynamic/WeakPrior.h"
#include "relations/RelationFactors.h"

namespace omnimapper::plugins::moveable_surfaces_test {
namespace {

using geometry::Segment2;
using Kind = plane_factors::PlaneParametrization::Kind;
using MeasuredAs = MoveableRoom::MeasuredAs;
using State = map::Landmark::State;

const Segment2 kSouth{{-3, -2.3}, {3, -2.3}}, kEast{{3, -2.3}, {3, 4.7}}, kNorth{{3, 4.7}, {-3, 4.7}},
    kWest{{-3, 4.7}, {-3, -2.3}};
const Segment2 kPanel{{2.4, 0.2}, {2.4, 2.2}}, kScreen{{-1, -1.8}, {1, -1.8}};

Segment2 shifted(const Segment2& wall, const Eigen::Vector2d& by) {
  return {wall.from + by, wall.to + by};
}

std::vector<base::LandmarkId> addWalls(MoveableRoom& room, Kind form, MeasuredAs seen = MeasuredAs::as_lines) {
  std::vector<base::LandmarkId> walls;
  for (const auto& wall : {kSouth, kEast, kNorth, kWest})
    walls.push_back(room.addSurface(form, wall, wall, seen, seen));
  return walls;
}

void addPoints(MoveableRoom& room) {
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(2.9, 0), {-2.5, 1}, {0.3, 4}, {1, -2}, {-2, -1.5}, {2, 4}})
    room.addPoint(at, at);
}

void expectWhole(const MoveableRoom& room) {
  EXPECT_TRUE(room.isKnown(room.run.map.key_frames.back().pose)) << "covariances are of the map after it";
  for (const auto& [id, landmark] : room.run.map.landmarks) {
    if (landmark.variables.empty()) continue;
    if (landmark.state == State::active) {
      EXPECT_TRUE(room.isKnown(landmark.variables.front())) << toString(id);
    } else {
      EXPECT_FALSE(room.actsOnAnything(id)) << toString(id);
    }
  }
}

class MoveableSurfaces : public ::testing::TestWithParam<Kind> {
 protected:
  std::shared_ptr<const graph::Factor> parallel() const {
    if (GetParam() == Kind::wall) return std::make_shared<WallTurnFactor>(0);
    return std::make_shared<PlanesParallelFactor>();
  }
  // Displacement of a wall in the east of the room to one in the south.
  std::shared_ptr<const graph::Factor> square() const {
    if (GetParam() == Kind::wall) return std::make_shared<WallTurnFactor>(-1);
    return std::make_shared<PlanesSquareFactor>();
  }
};

TEST_P(MoveableSurfaces, WhatStandsIsLeftAlone) {
  MoveableRoom room;
  addPoints(room);
  const auto walls = addWalls(room, GetParam());
  room.relate(walls[1], walls[0], square());
  room.look();
  for (const auto id : walls) EXPECT_EQ(room.stateOf(id), State::active);
  expectWhole(room);
}

TEST_P(MoveableSurfaces, AMovedOneIsFoundWithBothItsPlaces) {
  MoveableRoom room;
  addPoints(room);
  const auto walls = addWalls(room, GetParam());
  const auto panel = room.addSurface(GetParam(), kPanel, shifted(kPanel, {-0.5, 1.5}));
  room.look();
  const auto* record = room.recordOf(panel);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->label, "wall");
  const auto shape = record->shape({}, room.run.map.key_frames);
  ASSERT_EQ(shape.points.size(), 2U);
  EXPECT_LT((shape.points[0].head<2>() - Eigen::Vector2d(2.4, 1.2)).norm(), 0.1) << shape.points[0].transpose();
  EXPECT_LT((shape.points[1].head<2>() - Eigen::Vector2d(1.9, 2.7)).norm(), 0.1) << shape.points[1].transpose();
  for (const auto id : walls) EXPECT_EQ(room.stateOf(id), State::active);
  EXPECT_LT(room.error(), 0.05);
  expectWhole(room);
}

TEST_P(MoveableSurfaces, RelationsOfAMovedOneGoWithIt) {
  MoveableRoom room;
  addPoints(room);
  const auto walls = addWalls(room, GetParam());
  const auto panel = room.addSurface(GetParam(), kPanel, shifted(kPanel, {-0.5, 0}));
  const auto screen = room.addSurface(GetParam(), kScreen, shifted(kScreen, {0, 0.6}));
  room.relate(panel, screen, square());
  room.relate(walls[1], panel, parallel());
  room.relate(walls[1], walls[0], square());
  room.look();
  EXPECT_TRUE(room.recordOf(panel));
  EXPECT_TRUE(room.recordOf(screen));
  EXPECT_TRUE(room.run.view().factorsOf(walls[1]).size() == 2 * MoveableRoom::kRound + 1 + (GetParam() == Kind::plane))
      << "its measurements, what holds it upright and its relation to what stands";
  EXPECT_LT(room.error(), 0.05);
  expectWhole(room);
}

// When all other factors have no weight, a relation binds them only to each other.
TEST_P(MoveableSurfaces, TwoThatMovedAndHoldOneAnotherAreUnconstrained) {
  MoveableRoom room;
  const auto panel = room.addSurface(GetParam(), kPanel, shifted(kPanel, {-0.5, 0}));
  const auto screen = room.addSurface(GetParam(), kScreen, shifted(kScreen, {0, 0.6}));
  room.relate(panel, screen, square());
  addPoints(room);
  ASSERT_NO_THROW(room.look());
  EXPECT_TRUE(room.recordOf(panel));
  EXPECT_TRUE(room.recordOf(screen));
  expectWhole(room);
}

INSTANTIATE_TEST_SUITE_P(Forms, MoveableSurfaces, ::testing::Values(Kind::plane, Kind::wall),
                         [](const auto& info) { return info.param == Kind::wall ? "Wall" : "Plane"; });

TEST(DynamicLandmarks, APointOnAMovedWallMovesWithIt) {
  MoveableRoom room;
  addPoints(room);
  addWalls(room, Kind::wall);
  const Eigen::Vector2d by(-0.5, 0), on_panel(2.4, 1);
  const auto panel = room.addSurface(Kind::wall, kPanel, shifted(kPanel, by));
  const auto point = room.addPoint(on_panel, on_panel + by);
  room.relate(point, panel, std::make_shared<PointOnWallFactor>());
  room.look();
  EXPECT_TRUE(room.recordOf(panel));
  EXPECT_TRUE(room.recordOf(point));
  expectWhole(room);
}

TEST(DynamicLandmarks, SeenAsPlanesAndAfterTheMoveAsLinesOfOneHeight) {
  MoveableRoom room;
  addPoints(room);
  addWalls(room, Kind::plane, MeasuredAs::as_planes);
  const auto panel =
      room.addSurface(Kind::plane, kPanel, shifted(kPanel, {-0.5, 0}), MeasuredAs::as_planes, MeasuredAs::as_lines);
  ASSERT_NO_THROW(room.look());
  EXPECT_TRUE(room.recordOf(panel)) << "its tilt is unknown there, but its distance is known";
  expectWhole(room);
}

TEST(DynamicLandmarks, WhatIsDeterminedNowhereIsGivenUp) {
  MoveableRoom room;
  addPoints(room);
  addWalls(room, Kind::plane);
  // It is seen once at each of three places.
  const auto point = room.addPoint({{2, {2, 1}}, {12, {1, 2}}, {30, {-1, 1}}});
  DynamicLandmarksOptions options;
  options.min_measurements = MoveableRoom::kRound + 1;
  const auto panel = room.addSurface(Kind::plane, kPanel, shifted(kPanel, {-0.5, 0}));
  room.look(options);
  for (const auto id : {point, panel}) {
    EXPECT_EQ(room.stateOf(id), State::retired);
    EXPECT_FALSE(room.recordOf(id));
  }
  EXPECT_TRUE(std::any_of(room.run.decisions.begin(), room.run.decisions.end(), [](const auto& decision) {
    return decision.reason.rfind("retired", 0) == 0 && !decision.accepted;
  }));
  EXPECT_LT(room.error(), 0.05);
  expectWhole(room);
}

TEST(DynamicLandmarks, ASessionThatOnlyMovedOnesTieToTheMapStaysTied) {
  MoveableRoom room(1, true);
  room.addPoint({2, 1}, {2, 2});  // no longer three metres apart
  room.addPoint({-1, 1}, {-1, -2});
  ASSERT_NO_THROW(room.look());
  expectWhole(room);
  EXPECT_EQ(
      room.run.decisions.back().reason,
      "it is undetermined which landmarks have moved: without the landmarks that seem to have moved, a part of the map "
      "is unconstrained");
}

// The difference of two planes is in the axes of each normal: geometry::tangentBasis is discontinuous where another
// axis of space becomes the smallest component.
TEST(Differences, ChangeWithBothValuesByTheirDerivatives) {
  const auto unit = [](double x, double y, double z) { return Eigen::Vector3d(x, y, z).normalized(); };
  struct Case {
    std::shared_ptr<const graph::Variable> kind;
    Eigen::VectorXd a, b;
  };
  const std::vector<Case> cases = {
      {plane_factors::planeVariable(), plane_factors::toValue(geometry::Plane3{unit(1, 0.101, 0.1), 2}),
       plane_factors::toValue(geometry::Plane3{unit(1, 0.1, 0.101), 2.001})},
      {plane_factors::wallVariable(), plane_factors::toValue(Segment2{{0, 0}, {2, 0}}),
       plane_factors::toValue(Segment2{{0, 0.1}, {2, 0.101}})},
      {graph::point2(), Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 5)}};
  for (const auto& [kind, a, b] : cases) {
    const auto difference = plane_factors::differenceOf(*kind, a, b);
    const int size = kind->tangentSize();
    constexpr double kStep = 1e-6;
    for (int column = 0; column < 2 * size; ++column) {
      Eigen::VectorXd delta = Eigen::VectorXd::Zero(2 * size), moved_a = a, moved_b = b, change(size);
      delta[column] = kStep;
      kind->plus(a.data(), delta.data(), moved_a.data());
      kind->plus(b.data(), delta.data() + size, moved_b.data());
      // In the axes of the unmoved `a`.
      Eigen::VectorXd of_a(size);
      kind->minus(moved_b.data(), a.data(), change.data());
      kind->minus(moved_a.data(), a.data(), of_a.data());
      const Eigen::VectorXd slope = (change - of_a - difference.change) / kStep;
      EXPECT_LT((slope - difference.by_both.col(column)).norm(), 0.02) << kind->kind() << " " << column;
    }
  }
}

TEST(WeakPrior, PullsToWhereItWasAndHardly) {
  graph::Graph graph;
  const auto id = graph.addVariable(plane_factors::planeVariable(),
                                    plane_factors::toValue(geometry::Plane3{Eigen::Vector3d::UnitX(), 2}));
  addWeakPrior(graph, id);
  EXPECT_EQ(graph.cost(), 0);
  graph.setValue(id, plane_factors::toValue(geometry::Plane3{Eigen::Vector3d(0.6, 0.8, 0), 3}));
  EXPECT_NEAR(2 * graph.cost(), (1 + std::pow(std::acos(0.6), 2)) / 1e4, 1e-12);
  graph::solve(graph);
  EXPECT_NEAR(graph.value(id)[0], 1, 1e-6);
  EXPECT_NEAR(graph.value(id)[3], 2, 1e-6);
}

}  // namespace
}  // namespace omnimapper::plugins::moveable_surfaces_test

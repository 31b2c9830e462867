#include <gtest/gtest.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <sstream>

#include "../../graph/Jacobians.h"
#include "RelationBox.h"
#include "relations/Relations.h"

namespace omnimapper::plugins::relations_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::kPi;
using geometry::Plane3;
using geometry::Segment2;
using graph::Evaluation;

Eigen::VectorXd wall(const Vector2d& from, const Vector2d& to) {
  return plane_factors::toValue(Segment2{from, to});
}

Eigen::VectorXd anyWall(testing::Dice& dice) {
  return wall({dice.uniform(-5, 5), dice.uniform(-5, 5)}, {dice.uniform(-5, 5), dice.uniform(-5, 5)});
}

Plane3 anyPlane(testing::Dice& dice) {
  return {Vector3d(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)).normalized(), dice.uniform(-5, 5)};
}

double residualOf(const graph::Factor& factor, const std::vector<Eigen::VectorXd>& values, int row = 0) {
  return Evaluation{factor, {}, values}.residual()[row];
}

// The wall y = 2, free above it.
TEST(RelationFactors, ResidualsAsWorkedByHand) {
  const Eigen::VectorXd level = wall({0, 2}, {4, 2});
  EXPECT_NEAR(residualOf(PointOnWallFactor(), {Vector2d(1, 2.3), level}), 0.3, 1e-12);
  EXPECT_NEAR(residualOf(Point3OnWallFactor(), {Vector3d(1, 2.3, 1.5), level}), 0.3, 1e-12);
  EXPECT_NEAR(residualOf(PointOnPlaneFactor(), {Vector3d(1, 2, 0.7), plane_factors::toValue(Plane3{{0, 0, 1}, -0.75})}),
              -0.05, 1e-12);
  // A quarter turn and 0.1 rad to the left.
  const Eigen::VectorXd turned = wall({5, 0}, {5 - std::sin(0.1), std::cos(0.1)});
  EXPECT_NEAR(residualOf(WallTurnFactor(1), {level, turned}), 0.1, 1e-12);
  EXPECT_NEAR(residualOf(WallTurnFactor(-1), {turned, level}), -0.1, 1e-12);
  const Eigen::VectorXd beside = wall({6, 2.05}, {8, 2.05});
  EXPECT_NEAR(residualOf(WallsAlignedFactor(), {level, beside}, 0), 0, 1e-12);
  EXPECT_NEAR(residualOf(WallsAlignedFactor(), {level, beside}, 1), 0.05, 1e-12);
  EXPECT_NEAR(residualOf(WallShiftFactor(), {level, turned}), -1.5 + 0.5 * (std::cos(0.1) - 1), 1e-12);
  const Plane3 a{{1, 0, 0}, 2}, b{{-std::cos(0.1), std::sin(0.1), 0}, 1}, c{{std::sin(0.1), std::cos(0.1), 0}, 1};
  EXPECT_NEAR(Evaluation({PlanesParallelFactor(), {}, {plane_factors::toValue(a), plane_factors::toValue(b)}})
                  .residual()
                  .norm(),
              std::sin(0.1), 1e-12);
  EXPECT_NEAR(residualOf(PlanesSquareFactor(), {plane_factors::toValue(a), plane_factors::toValue(c)}), std::sin(0.1),
              1e-12);
  const PlanesAlignedFactor aligned(Vector3d(-2, 7, 0));
  EXPECT_NEAR(residualOf(aligned, {plane_factors::toValue(a), plane_factors::toValue(Plane3{{1, 0, 0}, 2.1})}, 2), 0.1,
              1e-12);
  const PlaneShiftFactor shifted(Vector3d(-2, 7, 0));
  EXPECT_NEAR(residualOf(shifted, {plane_factors::toValue(a), plane_factors::toValue(Plane3{{1, 0, 0}, 2.1})}), 0.1,
              1e-12);
}

TEST(RelationFactors, JacobiansMatchDifferences) {
  testing::Dice dice(1);
  for (int i = 0; i < 30; ++i) {
    const Vector2d point2(dice.uniform(-5, 5), dice.uniform(-5, 5));
    const Vector3d point3(dice.uniform(-5, 5), dice.uniform(-5, 5), dice.uniform(-5, 5));
    const std::vector<std::shared_ptr<const graph::Variable>> walls = {plane_factors::wallVariable(),
                                                                       plane_factors::wallVariable()},
                                                              planes = {plane_factors::planeVariable(),
                                                                        plane_factors::planeVariable()};
    graph::expectJacobiansMatchDifferences(
        {PointOnWallFactor(), {graph::point2(), plane_factors::wallVariable()}, {point2, anyWall(dice)}});
    graph::expectJacobiansMatchDifferences(
        {Point3OnWallFactor(), {graph::point3(), plane_factors::wallVariable()}, {point3, anyWall(dice)}});
    graph::expectJacobiansMatchDifferences({PointOnPlaneFactor(),
                                            {graph::point3(), plane_factors::planeVariable()},
                                            {point3, plane_factors::toValue(anyPlane(dice))}});
    graph::expectJacobiansMatchDifferences({WallTurnFactor(i), walls, {anyWall(dice), anyWall(dice)}});
    graph::expectJacobiansMatchDifferences({WallsAlignedFactor(), walls, {anyWall(dice), anyWall(dice)}});
    graph::expectJacobiansMatchDifferences({WallShiftFactor(), walls, {anyWall(dice), anyWall(dice)}});
    const std::vector<Eigen::VectorXd> two = {plane_factors::toValue(anyPlane(dice)),
                                              plane_factors::toValue(anyPlane(dice))};
    graph::expectJacobiansMatchDifferences({PlanesParallelFactor(), planes, two});
    graph::expectJacobiansMatchDifferences({PlanesSquareFactor(), planes, two});
    graph::expectJacobiansMatchDifferences({PlanesAlignedFactor(point3), planes, two});
    graph::expectJacobiansMatchDifferences({PlaneShiftFactor(point3), planes, two});
  }
}

// Four walls with errors of a few degrees, and their true values.
TEST(RelationFactors, MakeABoxOfFourWalls) {
  graph::Graph graph;
  const std::vector<Segment2> truth = {{{3, 0}, {0, 0}}, {{3, 4}, {3, 0}}, {{0, 4}, {3, 4}}, {{0, 0}, {0, 4}}};
  std::vector<base::VariableId> ids;
  testing::Dice dice(2);
  for (const auto& side : truth) {
    const Vector2d off(ids.empty() ? 0 : dice.uniform(-0.1, 0.1), 0);
    Eigen::Vector4d start;
    plane_factors::wallVariable()->plus(plane_factors::toValue(side).data(), off.data(), start.data());
    ids.push_back(graph.addVariable(plane_factors::wallVariable(), start, ids.empty()));
  }
  const auto noise = graph::SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(1, 0.01));
  for (int i = 1; i < 4; ++i) {
    graph.addFactor({{ids[0], ids[i]}, std::make_shared<WallTurnFactor>(i), noise});
    const auto corner = graph.addVariable(graph::point2(), middle(truth[i]), true);
    graph.addFactor({{corner, ids[i]}, std::make_shared<PointOnWallFactor>(), noise});
  }
  graph::solve(graph);
  for (int i = 0; i < 4; ++i) {
    const Segment2 found = plane_factors::wallFromValue(graph.value(ids[i]).data());
    EXPECT_LT((direction(found) - direction(truth[i])).norm(), 1e-6) << i;
  }
}

TEST(RelationFactors, ComeBackFromAFile) {
  graph::Graph graph;
  const auto w1 = graph.addVariable(plane_factors::wallVariable(), wall({0, 0}, {1, 0})),
             w2 = graph.addVariable(plane_factors::wallVariable(), wall({0, 1}, {1, 2}));
  const auto p1 = graph.addVariable(plane_factors::planeVariable(), plane_factors::toValue(Plane3{{1, 0, 0}, 1})),
             p2 = graph.addVariable(plane_factors::planeVariable(), plane_factors::toValue(Plane3{{0.6, 0.8, 0}, 1}));
  const auto q2 = graph.addVariable(graph::point2(), Vector2d(1, 2));
  const auto q3 = graph.addVariable(graph::point3(), Vector3d(1, 2, 3));
  const auto add = [&](std::vector<base::VariableId> ids, std::shared_ptr<const graph::Factor> factor) {
    graph.addFactor({ids, factor, graph::SquareRootInformation::identity(factor->residualSize())});
  };
  add({q2, w1}, std::make_shared<PointOnWallFactor>());
  add({q3, p1}, std::make_shared<PointOnPlaneFactor>());
  add({w1, w2}, std::make_shared<WallTurnFactor>(3));
  add({w1, w2}, std::make_shared<WallsAlignedFactor>());
  add({w1, w2}, std::make_shared<WallShiftFactor>());
  add({p1, p2}, std::make_shared<PlanesParallelFactor>());
  add({p1, p2}, std::make_shared<PlanesSquareFactor>());
  add({p1, p2}, std::make_shared<PlanesAlignedFactor>(Vector3d(1, 2, 3)));
  add({p1, p2}, std::make_shared<PlaneShiftFactor>(Vector3d(1, 2, 3)));
  std::stringstream bytes;
  graph::writeGraph(graph, bytes);
  auto registry = graph::FactorRegistry::withBuiltIns();
  registry.add(plane_factors::wallVariable());
  registry.add(plane_factors::planeVariable());
  addRelationsTo(registry);
  const graph::Graph back = graph::readGraph(bytes, registry);
  for (const auto& [id, record] : graph.factors()) EXPECT_EQ(back.whitenedResidual(id), graph.whitenedResidual(id));
}

struct Sums {
  double none = 0, found = 0, given = 0, with_wrong = 0, pose_none = 0, pose_found = 0;
  int wrong_acting = 0;
};

// Thesis 4.5.2.4 over a few seeds; doc/results/relations.md has more.
TEST(Relations, InTheBoxOfTheThesisAreFoundAndWrongOnesRefused) {
  Sums sums;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    using With = RelationBox::With;
    const auto none = RelationBox(seed).run(With::no_relations, 0, true);
    const auto found = RelationBox(seed).run(With::found, 0, true);
    const auto given = RelationBox(seed).run(With::true_ones, 0, false);
    const auto with_wrong = RelationBox(seed).run(With::true_ones, 3, true);
    sums.none += none.landmark;
    sums.found += found.landmark;
    sums.given += given.landmark;
    sums.with_wrong += with_wrong.landmark;
    sums.pose_none += none.pose;
    sums.pose_found += found.pose;
    sums.wrong_acting += with_wrong.wrong;
  }
  EXPECT_LT(sums.found, 1.1 * sums.given);
  EXPECT_LT(sums.given, 0.8 * sums.none);
  EXPECT_LT(sums.with_wrong, 1.2 * sums.given);
  EXPECT_LT(sums.pose_found, 1.05 * sums.pose_none);
  EXPECT_EQ(sums.wrong_acting, 0);
}

}  // namespace
}  // namespace omnimapper::plugins::relations_test

#include <gtest/gtest.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/PlaneParametrization.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/plane_factors/WallVariable.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <sstream>

#include "../graph/Jacobians.h"

namespace omnimapper::plane_factors::wall_factor_test {
namespace {

using Eigen::Vector2d;
using geometry::kPi;
using geometry::Se2;
using geometry::Segment2;
using graph::Evaluation;
using graph::SquareRootInformation;

Segment2 anyWall(testing::Dice& dice) {
  return {{dice.uniform(-9, 9), dice.uniform(-9, 9)}, {dice.uniform(-9, 9), dice.uniform(-9, 9)}};
}

Evaluation at(const WallFactor& factor, const Se2& map_from_base, const Segment2& wall) {
  return {factor, {graph::se2(), wallVariable()}, {graph::toValue(map_from_base), toValue(wall)}};
}

TEST(WallVariable, IsTheKindThatFactorsName) {
  EXPECT_EQ(WallKind::kName, wallVariable()->kind());
  EXPECT_EQ(+WallKind::kTangentSize, wallVariable()->tangentSize());
}

TEST(WallVariable, TurnsAboutItsMiddleAndShiftsToTheFreeSide) {
  const Segment2 wall{{0, 2}, {4, 2}};  // free above it
  EXPECT_LT((normalOf(wall) - Vector2d(0, 1)).norm(), 1e-15);
  const Vector2d delta(kPi / 2, 0.5);
  Eigen::Vector4d moved;
  wallVariable()->plus(toValue(wall).data(), delta.data(), moved.data());
  EXPECT_LT((moved - Eigen::Vector4d(2, 0.5, 2, 4.5)).norm(), 1e-12);
}

TEST(WallVariable, MinusUndoesPlus) {
  testing::Dice dice(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector4d x = toValue(anyWall(dice));
    const Vector2d delta(dice.uniform(-3, 3), dice.uniform(-3, 3));
    Eigen::Vector4d y;
    wallVariable()->plus(x.data(), delta.data(), y.data());
    Vector2d back;
    wallVariable()->minus(y.data(), x.data(), back.data());
    EXPECT_LT((back - delta).norm(), 1e-9);
  }
}

// The wall y = 2, free below; the robot at (1, 0.5) looks at it and measures it 1.4 m ahead instead of 1.5, and
// rotated.
TEST(WallFactor, ResidualAsWorkedByHand) {
  const Segment2 wall{{4, 2}, {0, 2}};
  const Se2 robot{1, 0.5, kPi / 2};
  const WallFactor exact({0, 1}, {1.5, -0.5});
  EXPECT_LT(at(exact, robot, wall).residual().norm(), 1e-12);
  const WallFactor off({std::sin(-0.1), std::cos(-0.1)}, {1.4, -0.5});
  const Eigen::VectorXd r = at(off, robot, wall).residual();
  EXPECT_NEAR(r[0], 0.1, 1e-12);  // turned counter-clockwise
  EXPECT_NEAR(r[1], 0.1, 1e-12);  // a point on the free side
}

TEST(WallFactor, JacobiansMatchDifferences) {
  testing::Dice dice(2);
  for (int i = 0; i < 50; ++i) {
    const double angle = dice.uniform(-3, 3);
    const WallFactor factor({std::cos(angle), std::sin(angle)}, {dice.uniform(-5, 5), dice.uniform(-5, 5)});
    graph::expectJacobiansMatchDifferences(
        at(factor, {dice.uniform(-5, 5), dice.uniform(-5, 5), dice.uniform(-3, 3)}, anyWall(dice)));
  }
}

TEST(WallFactor, TwoWallsDetermineAPose) {
  const std::vector<Segment2> walls = {{{5, 0}, {5, 4}}, {{4, 3}, {0, 3}}};
  const Se2 truth{1.5, 0.5, 0.7};
  graph::Graph graph;
  const auto noise = SquareRootInformation::fromSigmas(Vector2d(0.01, 0.02));
  const auto first = graph.addVariable(graph::se2(), graph::toValue(Se2{}), true);
  const auto second = graph.addVariable(graph::se2(), graph::toValue(plus(truth, {0.4, -0.3, 0.3})));
  for (const Segment2& wall : walls) {
    const Vector2d off(0.2, -0.3);
    Eigen::Vector4d start;
    wallVariable()->plus(toValue(wall).data(), off.data(), start.data());
    const auto id = graph.addVariable(wallVariable(), start);
    for (const auto& [pose, pose_id] : {std::pair(Se2{}, first), std::pair(truth, second)}) {
      const Se2 base_from_map = inverse(pose);
      const Vector2d seen = base_from_map * middle(wall);
      graph.addFactor(
          {{pose_id, id}, std::make_shared<WallFactor>(base_from_map.rotation() * direction(wall), seen), noise});
    }
  }
  graph::solve(graph);
  EXPECT_LT(minus(graph::se2FromValue(graph.value(second).data()), truth).norm(), 1e-6);
}

TEST(WallFactor, ComesBackFromAFile) {
  graph::Graph graph;
  const auto pose = graph.addVariable(graph::se2(), Eigen::Vector3d(1, 2, 3));
  const auto wall = graph.addVariable(wallVariable(), Eigen::Vector4d(0, 0, 3, 1));
  graph.addFactor({{pose, wall},
                   std::make_shared<WallFactor>(Vector2d(0.6, 0.8), Vector2d(2, 1)),
                   SquareRootInformation::identity(2)});
  std::stringstream bytes;
  graph::writeGraph(graph, bytes);
  auto registry = graph::FactorRegistry::withBuiltIns();
  registry.add(wallVariable());
  WallFactor::addTo(registry);
  const graph::Graph back = graph::readGraph(bytes, registry);
  for (const auto& [factor, record] : graph.factors())
    EXPECT_EQ(back.whitenedResidual(factor), graph.whitenedResidual(factor));
}

// What merging compares: the derivatives of the difference by both surfaces.
class PlaneParametrizationTest : public ::testing::TestWithParam<PlaneParametrization::Kind> {};

TEST_P(PlaneParametrizationTest, DifferenceChangesAsItSays) {
  const PlaneParametrization& form = PlaneParametrization::of(GetParam());
  const auto& kind = *form.variable();
  const int size = kind.tangentSize();
  // The axes of a plane's tangent are discontinuous where the two smallest coordinates of its normal are equal; here
  // they are not.
  const geometry::Plane3 plane{{-0.8, 0.6, 0}, 2};
  const Eigen::Vector3d foot = -plane.distance * plane.normal, along(0.6, 0.8, 0);
  const Eigen::VectorXd a = form.value(plane, {foot - along, foot + along});
  Eigen::VectorXd b(4), delta = Eigen::VectorXd::Constant(size, 0.01);
  kind.plus(a.data(), delta.data(), b.data());
  const auto difference = form.difference(a, b);
  EXPECT_LT((difference.change - delta).norm(), 1e-9);
  const double h = 1e-6;
  for (int column = 0; column < 2 * size; ++column) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(size), moved(4);
    step[column % size] = h;
    const Eigen::VectorXd& start = column < size ? a : b;
    kind.plus(start.data(), step.data(), moved.data());
    const auto after = column < size ? form.difference(moved, b) : form.difference(a, moved);
    // To first order if both are nearly the same.
    EXPECT_LT(((after.change - difference.change) / h - difference.by_both.col(column)).norm(), 0.02) << column;
  }
}

TEST_P(PlaneParametrizationTest, AValueGivesItsPlaneBack) {
  const PlaneParametrization& form = PlaneParametrization::of(GetParam());
  const geometry::Plane3 plane{{-0.6, 0.8, 0}, 1.5};
  const Eigen::Vector3d foot = -plane.distance * plane.normal, along(0.8, 0.6, 0);
  const auto back = form.plane(form.value(plane, {foot - along, foot + 2 * along}));
  EXPECT_LT((back.normal - plane.normal).norm(), 1e-12);
  EXPECT_NEAR(back.distance, plane.distance, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Both, PlaneParametrizationTest,
                         ::testing::Values(PlaneParametrization::Kind::plane, PlaneParametrization::Kind::wall));

}  // namespace
}  // namespace omnimapper::plane_factors::wall_factor_test

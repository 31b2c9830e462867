#include <gtest/gtest.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/PlaneFactors.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <sstream>

#include "../graph/Jacobians.h"

namespace omnimapper::plane_factors::plane_factors_test {
namespace {

using Eigen::Vector3d;
using geometry::kPi;
using geometry::Plane3;
using geometry::Se3;
using graph::Evaluation;
using graph::SquareRootInformation;

// 2 m ahead of the origin, facing it; the robot is at (1, 3), looking along y: the wall is on its right, 1 m away.
const Plane3 kWall{{-1, 0, 0}, 2};
const Se3 kLookingAlongY{geometry::expSo3({0, 0, kPi / 2}), {1, 3, 0}};

Se3 anyPose(testing::Dice& dice, double reach = 20) {
  const auto any = [&](double most) { return dice.uniform(-most, most); };
  return {geometry::expSo3({any(1.5), any(1.5), any(1.5)}), {any(reach), any(reach), any(reach)}};
}

Plane3 anyPlane(testing::Dice& dice) {
  const Vector3d normal(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1));
  return {normal.normalized(), dice.uniform(-5, 5)};
}

Evaluation at(const graph::Factor& factor, const Se3& map_from_base, const Plane3& plane) {
  return {factor, {graph::se3(), planeVariable()}, {graph::toValue(map_from_base), toValue(plane)}};
}

graph::FactorRegistry registry() {
  auto registry = graph::FactorRegistry::withBuiltIns();
  registry.add(planeVariable());
  PlaneFactor::addTo(registry);
  LineOnPlaneFactor::addTo(registry);
  UprightFactor::addTo(registry);
  return registry;
}

TEST(PlaneVariable, IsTheKindThatFactorsName) {
  EXPECT_EQ(PlaneKind::kName, planeVariable()->kind());
  EXPECT_EQ(+PlaneKind::kTangentSize, planeVariable()->tangentSize());
}

TEST(PlaneVariable, PlusAndMinusAreInverseAndKeepTheNormalUnit) {
  testing::Dice dice(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector4d x = toValue(anyPlane(dice));
    const Vector3d delta(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-3, 3));
    Eigen::Vector4d y;
    planeVariable()->plus(x.data(), delta.data(), y.data());
    EXPECT_NEAR(y.head<3>().norm(), 1, 1e-12);
    Vector3d back;
    planeVariable()->minus(y.data(), x.data(), back.data());
    EXPECT_LT((back - delta).norm(), 1e-9);
  }
}

// Measured 0.1 m too far, and turned by 0.2 rad about the upright axis.
TEST(PlaneFactor, ResidualAsWorkedByHand) {
  const Plane3 in_base{{0, 1, 0}, 1};  // the wall as the robot should see it
  const Plane3 measured{Eigen::AngleAxisd(0.2, Vector3d::UnitZ()) * in_base.normal, 1.1};
  const PlaneFactor exact(in_base), wrong(measured);
  EXPECT_LT(at(exact, kLookingAlongY, kWall).residual().norm(), 1e-12);
  const Eigen::VectorXd r = at(wrong, kLookingAlongY, kWall).residual();
  EXPECT_NEAR(r.head<2>().norm(), 0.2, 1e-12);
  EXPECT_NEAR(r[2], -0.1, 1e-12);
}

TEST(PlaneFactor, JacobiansMatchDifferences) {
  testing::Dice dice(2);
  for (int i = 0; i < 50; ++i) {
    const Se3 pose = anyPose(dice);
    const Plane3 plane = anyPlane(dice);
    // Near the prediction, at it, and anywhere.
    const Plane3 predicted = inverse(pose) * plane;
    const Plane3 measured = i % 3 == 0   ? predicted
                            : i % 3 == 1 ? geometry::plus(predicted, Vector3d(0.1, -0.05, 0.2))
                                         : anyPlane(dice);
    const PlaneFactor factor(measured);
    graph::expectJacobiansMatchDifferences(at(factor, pose, plane));
  }
}

// The scan is level, 0.4 m above the ground; the wall's line runs along the robot's x, 1 m to its right.
TEST(LineOnPlaneFactor, ResidualAsWorkedByHand) {
  const Vector3d direction(1, 0, 0), middle(2, -1, 0.4);
  EXPECT_LT(at(LineOnPlaneFactor(direction, middle), kLookingAlongY, kWall).residual().norm(), 1e-12);
  // Measured 5 cm nearer, and turned by 0.1 rad.
  const LineOnPlaneFactor wrong({std::cos(0.1), std::sin(0.1), 0}, {2, -0.95, 0.4});
  const Eigen::VectorXd r = at(wrong, kLookingAlongY, kWall).residual();
  EXPECT_NEAR(r[0], std::sin(0.1), 1e-12);
  EXPECT_NEAR(r[1], 0.05, 1e-12);
}

TEST(LineOnPlaneFactor, LeavesTheTurnAboutTheLineOpen) {
  const LineOnPlaneFactor line({1, 0, 0}, {2, -1, 0.4});
  const Vector3d on_line = kLookingAlongY * Vector3d(2, -1, 0.4);
  const Vector3d along = kLookingAlongY.rotation * Vector3d::UnitX();
  for (const double turn : {0.3, -1.0, 2.0}) {
    const Plane3 tilted = Plane3::through(on_line, Eigen::AngleAxisd(turn, along) * kWall.normal);
    EXPECT_LT(at(line, kLookingAlongY, tilted).residual().norm(), 1e-12);
  }
}

TEST(LineOnPlaneFactor, JacobiansMatchDifferences) {
  testing::Dice dice(3);
  for (int i = 0; i < 50; ++i) {
    const LineOnPlaneFactor factor(anyPlane(dice).normal, anyPose(dice, 5).translation);
    graph::expectJacobiansMatchDifferences(at(factor, anyPose(dice), anyPlane(dice)));
  }
}

TEST(UprightFactor, IsTheTangentOfTheTilt) {
  const UprightFactor factor;
  for (const double tilt : {0.0, 0.2, -0.4, 1.4}) {
    const Plane3 plane{{std::cos(tilt), 0, std::sin(tilt)}, 3};
    const Evaluation evaluation{factor, {planeVariable()}, {toValue(plane)}};
    EXPECT_NEAR(evaluation.residual()[0], std::tan(tilt), 1e-12);
    graph::expectJacobiansMatchDifferences(evaluation);
  }
}

TEST(UprightFactor, IsFiniteForALevelPlane) {
  const UprightFactor factor;
  const Evaluation evaluation{factor, {planeVariable()}, {toValue(Plane3{{0, 0, -1}, 1})}};
  EXPECT_NEAR(evaluation.residual()[0], -100, 1e-9);
}

// Two poses, one plane: the second pose and the plane have very wrong initial values, and are found.
TEST(PlaneFactor, ThreePlanesDetermineAPose) {
  testing::Dice dice(4);
  const Se3 truth = anyPose(dice, 3);
  const std::vector<Plane3> planes = {{{-1, 0, 0}, 6}, {{0, -1, 0}, 5}, {{0, 0, 1}, 0}};
  graph::Graph graph;
  const auto noise = SquareRootInformation::fromSigmas(Vector3d(0.01, 0.01, 0.02));
  const auto first = graph.addVariable(graph::se3(), graph::toValue(Se3{}), true);
  const auto second = graph.addVariable(
      graph::se3(), graph::toValue(plus(truth, (geometry::Vector6d() << 0.5, -0.4, 0.3, 0.2, -0.3, 0.4).finished())));
  for (const Plane3& plane : planes) {
    const auto id = graph.addVariable(planeVariable(), toValue(geometry::plus(plane, Vector3d(0.2, -0.1, 0.3))));
    graph.addFactor({{first, id}, std::make_shared<PlaneFactor>(plane), noise});
    graph.addFactor({{second, id}, std::make_shared<PlaneFactor>(inverse(truth) * plane), noise});
  }
  graph::solve(graph);
  EXPECT_LT(minus(graph::se3FromValue(graph.value(second).data()), truth).norm(), 1e-6);
}

// A laser at two heights determines the tilt of a wall; one height and the prior leave it upright.
TEST(LineOnPlaneFactor, TwoHeightsDetermineTheTilt) {
  const double tilt = 0.1;
  const Plane3 wall = Plane3::through({2, 0, 0}, {-std::cos(tilt), 0, std::sin(tilt)});
  const auto solved = [&](const std::vector<double>& heights, double upright_sigma) {
    graph::Graph graph;
    const auto pose = graph.addVariable(graph::se3(), graph::toValue(Se3{}), true);
    const auto id = graph.addVariable(planeVariable(), toValue({{-1, 0, 0}, 1.5}));
    for (const double z : heights) {
      const double x = 2 + z * std::tan(tilt);
      graph.addFactor({{pose, id},
                       std::make_shared<LineOnPlaneFactor>(Vector3d::UnitY(), Vector3d(x, 0.5, z)),
                       SquareRootInformation::fromSigmas(Eigen::Vector2d(0.005, 0.005))});
    }
    graph.addFactor({{id},
                     std::make_shared<UprightFactor>(),
                     SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(1, upright_sigma))});
    graph::solve(graph);
    return planeFromValue(graph.value(id).data());
  };
  const Plane3 determined = solved({0.3, 1.5}, 1.0);
  EXPECT_LT(geometry::minus(determined, wall).norm(), 1e-3);
  const Plane3 undetermined = solved({0.3}, 0.1);
  EXPECT_NEAR(undetermined.normal.z(), 0, 1e-6);
  EXPECT_NEAR(signedDistance(undetermined, {2 + 0.3 * std::tan(tilt), 7, 0.3}), 0, 1e-6);
}

TEST(PlaneFactors, ComeBackFromAFile) {
  graph::Graph graph;
  const auto pose = graph.addVariable(graph::se3(), graph::toValue(kLookingAlongY));
  const auto id = graph.addVariable(planeVariable(), toValue(kWall));
  graph.addFactor(
      {{pose, id}, std::make_shared<PlaneFactor>(Plane3{{0, 0.6, 0.8}, 1.5}), SquareRootInformation::identity(3)});
  graph.addFactor({{pose, id},
                   std::make_shared<LineOnPlaneFactor>(Vector3d(0.6, 0.8, 0), Vector3d(1, 2, 3)),
                   SquareRootInformation::identity(2)});
  graph.addFactor({{id}, std::make_shared<UprightFactor>(), SquareRootInformation::identity(1)});
  std::stringstream bytes;
  graph::writeGraph(graph, bytes);
  const graph::Graph back = graph::readGraph(bytes, registry());
  ASSERT_EQ(back.factors().size(), 3u);
  for (const auto& [factor, record] : graph.factors())
    EXPECT_EQ(back.whitenedResidual(factor), graph.whitenedResidual(factor));
}

}  // namespace
}  // namespace omnimapper::plane_factors::plane_factors_test

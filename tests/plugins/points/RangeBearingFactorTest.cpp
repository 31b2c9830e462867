#include <gtest/gtest.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/graph/Linearized.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <sstream>

#include "../../graph/Jacobians.h"
#include "points/RangeBearingFactor.h"

namespace omnimapper::plugins::range_bearing_factor_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::kPi;
using geometry::Se2;
using geometry::Se3;
using graph::Evaluation;
using graph::SquareRootInformation;

Evaluation at(const graph::Factor& factor, const Se2& map_from_base, const Vector2d& point) {
  return {factor, {graph::se2(), graph::point2()}, {graph::toValue(map_from_base), point}};
}

Evaluation at(const graph::Factor& factor, const Se3& map_from_base, const Vector3d& point) {
  return {factor, {graph::se3(), graph::point3()}, {graph::toValue(map_from_base), point}};
}

Se3 anyPose(testing::Dice& dice, double reach) {
  const auto any = [&](double most) { return dice.uniform(-most, most); };
  return {geometry::expSo3({any(1.5), any(1.5), any(1.5)}), {any(reach), any(reach), any(reach)}};
}

Vector3d seen(const Se3& map_from_sensor, const Vector3d& point) {
  const Vector3d u = inverse(map_from_sensor) * point;
  return {u.norm(), std::atan2(u.y(), u.x()), std::atan2(-u.z(), u.head<2>().norm())};
}

// The numbers of doc/derivations/range_bearing.md.
TEST(RangeBearingFactor2, ResidualAsWorkedByHand) {
  const RangeBearingFactor2 factor({0.5, 0}, 4.9, 0.6);
  const Eigen::VectorXd r = at(factor, Se2{1, 1, kPi / 2}, Vector2d(-2, 5.5)).residual();
  EXPECT_NEAR(r[0], 0.1, 1e-12);
  EXPECT_NEAR(r[1], std::atan2(3, 4) - 0.6, 1e-12);
}

TEST(RangeBearingFactor3, ResidualAsWorkedByHand) {
  const Se3 map_from_base{geometry::expSo3({0, 0, kPi / 2}), {1, 1, 0}};
  const RangeBearingFactor3 factor({Eigen::Quaterniond::Identity(), {0.5, 0, 1}}, {12.9, 0.6, 1.1});
  const Eigen::VectorXd r = at(factor, map_from_base, {-2, 5.5, -11}).residual();
  EXPECT_NEAR(r[0], 0.1, 1e-12);
  EXPECT_NEAR(r[1], std::atan2(3, 4) - 0.6, 1e-12);
  EXPECT_NEAR(r[2], std::atan2(12, 5) - 1.1, 1e-12);
}

// Behind the sensor: measured a little to the left, predicted a little to the right.
TEST(RangeBearingFactors, AnglesDoNotJumpBehindTheSensor) {
  const RangeBearingFactor2 planar({0, 0}, 2, kPi - 0.05);
  EXPECT_NEAR(at(planar, Se2{}, Vector2d(-2, -0.1)).residual()[1], 0.1, 1e-3);
  const RangeBearingFactor3 spatial(Se3{}, {2, kPi - 0.05, 0});
  EXPECT_NEAR(at(spatial, Se3{}, Vector3d(-2, -0.1, 0)).residual()[1], 0.1, 1e-3);
}

TEST(RangeBearingFactors, AreFiniteAtTheSensorAndStraightAbove) {
  const RangeBearingFactor2 planar({0, 0}, 2, 0.1);
  for (const auto& jacobian : at(planar, Se2{}, Vector2d(0, 0)).jacobians()) EXPECT_TRUE(jacobian.allFinite());
  const RangeBearingFactor3 spatial(Se3{}, {2, 0.1, 0});
  for (const Vector3d& point : {Vector3d(0, 0, 0), Vector3d(0, 0, 2)})
    for (const auto& jacobian : at(spatial, Se3{}, point).jacobians()) EXPECT_TRUE(jacobian.allFinite());
}

TEST(RangeBearingFactors, JacobiansMatchDifferences) {
  testing::Dice dice(1);
  for (int i = 0; i < 50; ++i) {
    const RangeBearingFactor2 planar({dice.uniform(-1, 1), dice.uniform(-1, 1)}, dice.uniform(1, 9),
                                     dice.uniform(-1, 1));
    const Vector2d point(dice.uniform(5, 9), dice.uniform(-9, 9));
    graph::expectJacobiansMatchDifferences(
        at(planar, Se2{dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-0.5, 0.5)}, point));
    // Off the axis of the sensor, where its yaw is undefined.
    const Se3 base = anyPose(dice, 5), sensor = anyPose(dice, 1);
    const Vector3d ahead(dice.uniform(2, 8), dice.uniform(-5, 5), dice.uniform(-5, 5));
    const RangeBearingFactor3 spatial(sensor, {dice.uniform(1, 9), dice.uniform(-1, 1), dice.uniform(-1, 1)});
    graph::expectJacobiansMatchDifferences(at(spatial, base, base * sensor * ahead), 1e-6);
  }
}

// Two poses and some points; the second pose and all points have very wrong initial values, and are found.
TEST(RangeBearingFactor2, FindsPoseAndPointsAgain) {
  testing::Dice dice(2);
  const Se2 truth{2, -1, 0.8};
  const Vector2d sensor(0.3, -0.1);
  graph::Graph graph;
  const auto noise = SquareRootInformation::fromSigmas(Vector2d(0.02, 0.01));
  const auto first = graph.addVariable(graph::se2(), graph::toValue(Se2{}), true);
  const auto second = graph.addVariable(graph::se2(), graph::toValue(Se2{2.4, -0.7, 0.5}));
  const std::vector<Vector2d> points = {{5, 1}, {4, -4}, {-3, 2}, {1, 6}};
  std::vector<base::VariableId> ids;
  for (const Vector2d& point : points) {
    ids.push_back(graph.addVariable(graph::point2(), point + Vector2d(dice.uniform(-0.5, 0.5), 0.3)));
    for (const auto& [pose, map_from_base] : {std::pair(first, Se2{}), std::pair(second, truth)}) {
      const Vector3d u = seen(lift(map_from_base) * lift(Se2{sensor.x(), sensor.y(), 0}), {point.x(), point.y(), 0});
      graph.addFactor({{pose, ids.back()}, std::make_shared<RangeBearingFactor2>(sensor, u[0], u[1]), noise});
    }
  }
  graph::solve(graph);
  EXPECT_LT((graph.value(second) - graph::toValue(truth)).norm(), 1e-6);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((graph.value(ids[i]) - points[i]).norm(), 1e-6);
}

TEST(RangeBearingFactor3, FindsPoseAndPointsAgain) {
  testing::Dice dice(3);
  const Se3 truth = anyPose(dice, 2), sensor = anyPose(dice, 0.5);
  graph::Graph graph;
  const auto noise = SquareRootInformation::fromSigmas(Vector3d(0.02, 0.01, 0.01));
  const auto first = graph.addVariable(graph::se3(), graph::toValue(Se3{}), true);
  const auto second = graph.addVariable(
      graph::se3(), graph::toValue(plus(truth, (geometry::Vector6d() << 0.3, -0.2, 0.3, 0.2, -0.1, 0.2).finished())));
  for (int i = 0; i < 6; ++i) {
    const Vector3d point(dice.uniform(-6, 6), dice.uniform(-6, 6), dice.uniform(-6, 6));
    const auto id = graph.addVariable(graph::point3(), point + Vector3d(0.2, -0.1, 0.2));
    for (const auto& [pose, map_from_base] : {std::pair(first, Se3{}), std::pair(second, truth)})
      graph.addFactor(
          {{pose, id}, std::make_shared<RangeBearingFactor3>(sensor, seen(map_from_base * sensor, point)), noise});
  }
  graph::solve(graph);
  EXPECT_LT(minus(graph::se3FromValue(graph.value(second).data()), truth).norm(), 1e-6);
}

TEST(RangeBearingFactors, ComeBackFromAFile) {
  graph::Graph graph;
  const auto base2 = graph.addVariable(graph::se2(), graph::toValue(Se2{1, 2, 3}));
  const auto point2 = graph.addVariable(graph::point2(), Vector2d(4, 5));
  const auto base3 = graph.addVariable(graph::se3(), graph::toValue(lift(Se2{1, 2, 3})));
  const auto point3 = graph.addVariable(graph::point3(), Vector3d(4, 5, 6));
  graph.addFactor({{base2, point2},
                   std::make_shared<RangeBearingFactor2>(Vector2d(0.1, 0.2), 3, 0.4),
                   SquareRootInformation::identity(2)});
  testing::Dice dice(4);
  graph.addFactor({{base3, point3},
                   std::make_shared<RangeBearingFactor3>(anyPose(dice, 1), Vector3d(3, 0.4, 0.5)),
                   SquareRootInformation::identity(3)});
  std::stringstream bytes;
  graph::writeGraph(graph, bytes);
  auto registry = graph::FactorRegistry::withBuiltIns();
  RangeBearingFactor2::addTo(registry);
  RangeBearingFactor3::addTo(registry);
  const graph::Graph back = graph::readGraph(bytes, registry);
  for (const auto& [factor, record] : graph.factors())
    EXPECT_EQ(back.whitenedResidual(factor), graph.whitenedResidual(factor));
}

// A g2o file has the coordinates in the base that give the same residual and the same information.
TEST(RangeBearingFactor, InAG2oFileItIsItsPointToFirstOrder) {
  const Eigen::Vector3d sigmas(0.1, 0.02, 0.03);
  graph::Graph planar, spatial;
  const auto pose2 = planar.addVariable(graph::se2(), Eigen::Vector3d(1, 2, 0.7), true);
  const auto point2 = planar.addVariable(graph::point2(), Eigen::Vector2d(4, 1));
  planar.addFactor({{pose2, point2},
                    std::make_shared<RangeBearingFactor2>(Eigen::Vector2d(0.2, 0.1), 3.3, -1.2),
                    graph::SquareRootInformation::fromSigmas(sigmas.head<2>())});
  const geometry::Se3 base{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized())),
                           {1, 2, 3}};
  const auto pose3 = spatial.addVariable(graph::se3(), graph::toValue(base), true);
  const auto point3 = spatial.addVariable(graph::point3(), Eigen::Vector3d(5, 3, 2));
  spatial.addFactor({{pose3, point3},
                     std::make_shared<RangeBearingFactor3>(geometry::Se3{base.rotation, {0.1, 0.2, 0.3}},
                                                           Eigen::Vector3d(4.2, 0.1, 0.2)),
                     graph::SquareRootInformation::fromSigmas(sigmas)});
  for (const auto* graph : {&planar, &spatial}) {
    std::stringstream text;
    graph::writeG2o(*graph, text);
    EXPECT_NE(text.str().find("# to first order: 1 of kind range_bearing"), std::string::npos) << text.str();
    const auto read = graph::readG2o(text, "written").graph;
    ASSERT_EQ(read.factors().size(), 1U);
    const graph::Linearized ours(*graph, (*graph->factors().begin()).first),
        theirs(read, (*read.factors().begin()).first);
    EXPECT_NEAR(ours.residual.squaredNorm(), theirs.residual.squaredNorm(), 1e-9);
    EXPECT_GT(ours.residual.squaredNorm(), 1);
    const auto information = [](const graph::Linearized& factor, int of) -> Eigen::MatrixXd {
      return factor.jacobians[of].transpose() * factor.jacobians[of];
    };
    EXPECT_LT((information(ours, 1) - information(theirs, 1)).norm(), 1e-9 * information(ours, 1).norm());
    const Eigen::VectorXd gradient = ours.jacobians[1].transpose() * ours.residual;
    EXPECT_LT((gradient - theirs.jacobians[1].transpose() * theirs.residual).norm(), 1e-9 * gradient.norm());
  }
}

}  // namespace
}  // namespace omnimapper::plugins::range_bearing_factor_test

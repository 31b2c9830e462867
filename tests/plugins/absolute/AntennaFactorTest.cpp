#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <sstream>

#include "../../graph/Jacobians.h"
#include "absolute/AntennaFactor.h"

namespace omnimapper::plugins::antenna_factor_test {
namespace {

using Eigen::Vector3d;
using geometry::Se3;

Se3 anyPose(testing::Dice& dice) {
  const auto any = [&](double reach) { return dice.uniform(-reach, reach); };
  return {geometry::expSo3({any(1.5), any(1.5), any(1.5)}), {any(20), any(20), any(20)}};
}

graph::FactorRegistry registry() {
  auto registry = graph::FactorRegistry::withBuiltIns();
  AntennaFactor::addTo(registry);
  return registry;
}

TEST(AntennaFactor, ResidualAsWorkedByHand) {
  // East lies along the map's y, north against its x.
  const Se3 map_from_enu{geometry::expSo3({0, 0, geometry::kPi / 2}), {10, 20, 0}};
  const Se3 map_from_base{Eigen::Quaterniond::Identity(), {12, 25, 1}};
  // The antenna is at (13, 25, 3) in the map, (3, 5, 3) from the origin of enu: 5 m east, 3 m south, 3 m up.
  const AntennaFactor spatial({1, 0, 2}, {5, -3.25, 2.5}, true), planar({1, 0, 2}, {5, -3.25, 2.5}, false);
  const std::vector<Eigen::VectorXd> values{graph::toValue(map_from_enu), graph::toValue(map_from_base)};
  const Eigen::VectorXd r3 = graph::Evaluation{spatial, {graph::se3(), graph::se3()}, values}.residual();
  ASSERT_EQ(r3.size(), 3);
  EXPECT_LT((r3 - Vector3d(0, 0.25, 0.5)).norm(), 1e-12) << r3.transpose();
  const Eigen::VectorXd r2 = graph::Evaluation{planar, {graph::se3(), graph::se3()}, values}.residual();
  ASSERT_EQ(r2.size(), 2);
  EXPECT_LT((r2 - r3.head<2>()).norm(), 1e-15);
}

TEST(AntennaFactor, JacobiansMatchDifferences) {
  testing::Dice dice(1);
  for (int i = 0; i < 20; ++i) {
    const AntennaFactor factor(Vector3d(dice.uniform(-2, 2), dice.uniform(-2, 2), dice.uniform(-2, 2)),
                               Vector3d(dice.uniform(-9, 9), dice.uniform(-9, 9), dice.uniform(-9, 9)), i % 2 == 0);
    graph::expectJacobiansMatchDifferences(
        {factor, {graph::se3(), graph::se3()}, {graph::toValue(anyPose(dice)), graph::toValue(anyPose(dice))}});
  }
}

TEST(AntennaFactor, FindsWhereTheMapIsFromExactFixes) {
  testing::Dice dice(2);
  const Se3 truth{geometry::expSo3({0.05, -0.1, 2.0}), {30, -12, 4}};
  const Vector3d lever(0.4, -0.2, 1.1);
  graph::Graph graph;
  const auto map_from_enu =
      graph.addVariable(graph::se3(), graph::toValue(plus(truth, 0.3 * geometry::Vector6d::Ones())));
  for (int i = 0; i < 8; ++i) {
    const Se3 map_from_base = anyPose(dice);
    const auto pose = graph.addVariable(graph::se3(), graph::toValue(map_from_base), true);
    const Vector3d antenna_in_enu = inverse(truth) * (map_from_base * lever);
    graph.addFactor({{map_from_enu, pose},
                     std::make_shared<AntennaFactor>(lever, antenna_in_enu, true),
                     graph::SquareRootInformation::identity(3),
                     {},
                     1,
                     {}});
  }
  graph::solve(graph);
  EXPECT_LT(minus(graph::se3FromValue(graph.value(map_from_enu).data()), truth).norm(), 1e-6);
}

TEST(AntennaFactor, TakesPosesOfAPlanarMapToo) {
  graph::Graph graph;
  const auto map_from_enu = graph.addVariable(graph::se2(), Vector3d(1, 2, 0.5), true);
  const auto pose = graph.addVariable(graph::se2(), Vector3d(0, 0, 0.2));
  const auto factor = graph.addFactor({{map_from_enu, pose},
                                       std::make_shared<AntennaFactor>(Vector3d(0, 0, 3), Vector3d(4, 1, 7), false),
                                       graph::SquareRootInformation::identity(2),
                                       {},
                                       1,
                                       {}});
  EXPECT_GT(graph.whitenedResidual(factor).norm(), 1);
  const geometry::Se2 antenna = geometry::Se2{1, 2, 0.5} * geometry::Se2{4, 1, 0};
  graph.setValue(pose, Vector3d(antenna.x, antenna.y, -1));
  EXPECT_LT(graph.whitenedResidual(factor).norm(), 1e-12)
      << "the antenna is above the base: its heading is unconstrained";
}

TEST(AntennaFactor, SurvivesTheArchiveOfAGraph) {
  graph::Graph graph;
  testing::Dice dice(3);
  const auto a = graph.addVariable(graph::se3(), graph::toValue(anyPose(dice)));
  const auto b = graph.addVariable(graph::se3(), graph::toValue(anyPose(dice)));
  for (const bool up : {false, true}) {
    graph.addFactor({{a, b},
                     std::make_shared<AntennaFactor>(Vector3d(0.1, 0.2, 0.3), Vector3d(4, 5, 6), up),
                     graph::SquareRootInformation::identity(up ? 3 : 2),
                     {},
                     1,
                     {}});
  }
  std::stringstream bytes;
  graph::writeGraph(graph, bytes);
  const auto read = graph::readGraph(bytes, registry());
  ASSERT_EQ(read.factors().size(), 2U);
  for (const auto& [id, record] : graph.factors()) EXPECT_EQ(read.whitenedResidual(id), graph.whitenedResidual(id));
}

TEST(AntennaFactor, BytesThatAreCutShortAreRefused) {
  std::ostringstream out;
  AntennaFactor({1, 2, 3}, {4, 5, 6}, true).write(out);
  const std::string bytes = out.str();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    std::istringstream in(bytes.substr(0, length));
    try {
      registry().readFactor("antenna", in);
      ADD_FAILURE() << length << " bytes were enough";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::damaged_input);
    }
  }
}

}  // namespace
}  // namespace omnimapper::plugins::antenna_factor_test

#include <gtest/gtest.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/Solver.h>

#include "Worlds.h"
#include "omnimapper/graph/SolveOne.h"

namespace omnimapper::graph::solve_one_test {
namespace {

TEST(SolveOne, GivesWhatSolveGivesWithAllOthersFixed) {
  World2 world = gridWorld(100, 1, {0.05, 0.05, 0.02});
  const base::VariableId last = world.ids.back();
  world.graph.setValue(last, toValue(plus(world.truth.back(), Eigen::Vector3d(0.5, -0.5, 0.4))));
  Graph whole = world.graph;
  for (const base::VariableId id : world.ids) whole.setFixed(id, id != last);
  solve(whole);
  const Graph before = world.graph;
  solveOne(world.graph, last);
  EXPECT_LT((world.graph.value(last) - whole.value(last)).norm(), 1e-5);
  EXPECT_LT(world.graph.cost(), before.cost());
  for (const base::VariableId id : world.ids) {
    if (id != last) {
      EXPECT_EQ(world.graph.value(id), before.value(id));
    }
  }
}

// A pose with a prior at its place, with a sigma of 0.7 m, and a measurement 3 m away with a sigma of 1 cm; the losses
// are Cauchy's, with scale 2. Staying costs 2 log(1 + 300^2 / 4) = 20.0, moving (3 / 0.7)^2 / 2 = 9.2: the measurement
// is right, though it looks like an outlier of 300 standard deviations. With 0.4 m, moving costs 28.1, and the
// measurement is an outlier, which pulls by 4 / (3 - x) against x / 0.16.
TEST(SolveOne, DistinguishesAWrongInitialValueFromAWrongMeasurement) {
  for (const auto& [sigma, expected] : {std::pair(0.7, 3.0), std::pair(0.4, 0.2311)}) {
    Graph graph;
    const auto origin = graph.addVariable(se2(), Eigen::Vector3d::Zero(), true);
    const auto pose = graph.addVariable(se2(), Eigen::Vector3d::Zero());
    graph.addFactor({{origin, pose},
                     std::make_shared<BetweenSe2>(geometry::Se2{}),
                     SquareRootInformation::fromSigmas(Eigen::Vector3d::Constant(sigma))});
    FactorRecord measured{{pose},
                          std::make_shared<PriorSe2>(geometry::Se2{3, 0, 0}),
                          SquareRootInformation::fromSigmas(Eigen::Vector3d::Constant(0.01))};
    measured.loss = Loss::cauchy(2);
    graph.addFactor(measured);
    solveOne(graph, pose);
    EXPECT_NEAR(graph.value(pose)[0], expected, 0.01) << sigma;
  }
}

TEST(SolveOne, LeavesFixedAndUnboundVariables) {
  World2 world = gridWorld(10, 2, {0.05, 0.05, 0.02});
  const base::VariableId alone = world.graph.addVariable(point2(), Eigen::Vector2d(1, 2));
  solveOne(world.graph, alone);
  EXPECT_EQ(world.graph.value(alone), Eigen::Vector2d(1, 2));
  solveOne(world.graph, world.ids[0]);
  EXPECT_EQ(world.graph.value(world.ids[0]), toValue(world.truth[0]));
}

}  // namespace
}  // namespace omnimapper::graph::solve_one_test

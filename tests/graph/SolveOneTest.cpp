#include <gtest/gtest.h>
#include <omnimapper/graph/PointFactor.h>
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

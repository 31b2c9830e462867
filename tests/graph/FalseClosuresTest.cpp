#include <gtest/gtest.h>
#include <omnimapper/testing/Fixtures.h>

#include "FalseClosures.h"
#include "Worlds.h"

namespace omnimapper::graph::false_closures_test {
namespace {

using Method = ConsistencyOptions::Method;

/// One in ten of the closures is false: half of these are single ones, half are in groups that agree.
void expectNoHarm(Problem problem, Method method, double bound_m) {
  const std::size_t true_ones = problem.closures.size();
  std::mt19937 rng(7);
  addFalseClosures(problem, 0.05, 1, rng);
  addFalseClosures(problem, 0.05, 10, rng);
  ASSERT_GT(problem.closures.size(), true_ones + true_ones / 11);
  Setting setting;
  setting.consistency.method = method;
  const Outcome outcome = Run(problem, setting).incremental(100, 30);
  EXPECT_LT(outcome.error_m, bound_m);
  EXPECT_LT(outcome.true_refused, static_cast<double>(true_ones) / 50);
  EXPECT_LE(outcome.false_accepted, static_cast<double>(true_ones) / 200);
}

class FalseClosuresTest : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, FalseClosuresTest, ::testing::Values(Method::pairwise, Method::graduated));

TEST_P(FalseClosuresTest, DoNoHarmInASimulatedTown) {
  const World2 world = gridWorld(800, 5, {0.03, 0.03, 0.01});
  Problem problem;
  problem.poses = static_cast<int>(world.ids.size());
  problem.truth = world.truth;
  for (const auto& [id, record] : world.graph.factors()) {
    const int a = static_cast<int>(record.variables[0].index), b = static_cast<int>(record.variables[1].index);
    const Edge edge{a, b, dynamic_cast<const BetweenSe2&>(*record.factor).measured(), record.noise};
    (b == a + 1 ? problem.odometry : problem.closures).push_back(edge);
  }
  Graph all = world.graph;
  solve(all);
  expectNoHarm(problem, GetParam(), 1.1 * errorOf(valuesOf(all), world.truth));
}

TEST_P(FalseClosuresTest, DoNoHarmInIntel) {
  const auto path = testing::sharedData("posegraphs/intel.g2o");
  OMNIMAPPER_NEEDS(path);
  expectNoHarm(fromG2o(*path), GetParam(), 0.01);  // from the optimum
}

TEST(FalseClosuresInManhattanTest, DoNoHarm) {
  const auto path = testing::sharedData("posegraphs/manhattan.g2o");
  OMNIMAPPER_NEEDS(path);
  expectNoHarm(fromG2o(*path), Method::pairwise, 0.3);  // from the optimum, which is 0.75 m off the truth
}

}  // namespace
}  // namespace omnimapper::graph::false_closures_test

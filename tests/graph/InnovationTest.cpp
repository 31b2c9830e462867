#include <gtest/gtest.h>
#include <omnimapper/graph/Solver.h>

#include "../../libs/graph/src/Innovation.h"
#include "Worlds.h"

namespace omnimapper::graph::innovation_test {
namespace {

FactorRecord step(base::VariableId a, base::VariableId b, double distance, double sigma) {
  return {{a, b},
          std::make_shared<BetweenSe2>(Se2{distance, 0, 0}),
          SquareRootInformation::fromSigmas(Eigen::Vector3d::Constant(sigma)),
          {},
          1,
          {}};
}

// A straight corridor of five poses, so that the problem is linear. An acting closure does not fit well: with a robust
// loss, its weight is less than one. Another closure is tested as if the first were not there.
class Withdrawal : public ::testing::TestWithParam<Loss::Kind> {};
INSTANTIATE_TEST_SUITE_P(Losses, Withdrawal,
                         ::testing::Values(Loss::Kind::none, Loss::Kind::huber, Loss::Kind::cauchy));

TEST_P(Withdrawal, IsTheGraphWithoutIt) {
  Graph graph;
  std::vector<base::VariableId> poses;
  for (int i = 0; i < 5; ++i) poses.push_back(graph.addVariable(se2(), toValue(Se2{double(i), 0, 0}), i == 0));
  for (std::size_t i = 1; i < poses.size(); ++i) graph.addFactor(step(poses[i - 1], poses[i], 1, 0.1));
  FactorRecord tense = step(poses[0], poses[4], 5, 0.1);
  if (GetParam() != Loss::Kind::none) tense.loss = Loss(GetParam(), 2);
  const auto acting = graph.addFactor(tense);
  FactorRecord other = step(poses[0], poses[3], 3.2, 0.05);
  other.weight = 0;
  const auto candidate = graph.addFactor(other);
  SolveOptions tight;
  tight.function_tolerance = 1e-15;
  solve(graph, tight);
  ASSERT_GT(graph.whitenedResidual(acting).norm(), 1.5) << "under tension";

  Innovation innovation(graph, Marginals(graph), {candidate, acting}, 1);
  innovation.withdraw({1});
  const InnovationStatistics withdrawn = innovation.of(0);

  // The covariance is at the same values; the residual is at the values of the solution without it.
  graph.setWeight(acting, 0);
  const InnovationStatistics without = Innovation(graph, Marginals(graph), {candidate}, 1).of(0);
  EXPECT_LT((withdrawn.covariance - without.covariance).norm(), 1e-6 * without.covariance.norm());
  solve(graph, tight);
  EXPECT_LT((withdrawn.residual - graph.whitenedResidual(candidate)).norm(), 1e-3);
}

}  // namespace
}  // namespace omnimapper::graph::innovation_test

#include <ceres/ceres.h>
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>

#include "GridEdge.h"
#include "Worlds.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph::solver_test {
namespace {

using base::FactorId;
using base::VariableId;

template <class Pose>
void perturb(World<Pose>& world, unsigned seed, double size) {
  Noise noise(seed);
  for (std::size_t i = 1; i < world.ids.size(); ++i) {
    const Variable& kind = *world.graph.variable(world.ids[i]).kind;
    Eigen::VectorXd value = world.graph.value(world.ids[i]);
    const Eigen::VectorXd delta = noise.normals(Eigen::VectorXd::Constant(kind.tangentSize(), size));
    kind.plus(value.data(), delta.data(), value.data());
    world.graph.setValue(world.ids[i], value);
  }
}

/// The largest distance of a pose from its truth, metres and radians alike.
template <class Pose>
double worstError(const World<Pose>& world) {
  double worst = 0;
  for (std::size_t i = 0; i < world.ids.size(); ++i)
    worst = std::max(worst, minus(poseOf<Pose>(world.graph, world.ids[i]), world.truth[i]).norm());
  return worst;
}

const SolveOptions::Method kMethods[] = {SolveOptions::Method::levenberg_marquardt, SolveOptions::Method::dogleg};

TEST(Solver, TwoMeasurementsOfAPointMeetByTheirWeights) {
  // 0 with sigma 1 and 3 with sigma 2: the mean is weighted 4 : 1.
  Graph graph;
  const VariableId pose = graph.addVariable(se2(), toValue(Se2{}), true);
  const VariableId point = graph.addVariable(point2(), Eigen::Vector2d(7, 7));
  graph.addFactor({{pose, point},
                   std::make_shared<PointFactor2>(Eigen::Vector2d(0, 0)),
                   SquareRootInformation::fromSigmas(Eigen::Vector2d(1, 1))});
  graph.addFactor({{pose, point},
                   std::make_shared<PointFactor2>(Eigen::Vector2d(3, 0)),
                   SquareRootInformation::fromSigmas(Eigen::Vector2d(2, 2))});
  const SolveSummary summary = solve(graph);
  EXPECT_TRUE(summary.converged) << summary.reason;
  EXPECT_LT((graph.value(point) - Eigen::Vector2d(0.6, 0)).norm(), 1e-10);
  EXPECT_NEAR(summary.final_cost, 0.5 * (0.36 + 1.44), 1e-12);
  EXPECT_NEAR(summary.initial_cost, 0.5 * (98 + 16.25), 1e-12);
}

TEST(Solver, RecoversTheTruthOfAnExactPlanarWorld) {
  for (const auto method : kMethods) {
    World2 world = gridWorld(200, 1, {1e-12, 1e-12, 1e-12});
    perturb(world, 2, 0.2);
    SolveOptions options;
    options.method = method;
    const SolveSummary summary = solve(world.graph, options);
    EXPECT_TRUE(summary.converged) << summary.reason;
    EXPECT_LT(worstError(world), 1e-7);
    EXPECT_LE(summary.final_cost, summary.initial_cost);
  }
}

TEST(Solver, RecoversTheTruthOfAnExactWorldInSpace) {
  for (const auto method : kMethods) {
    World3 world = sphereWorld(6, 12, 1, 1e-12, 1e-12);
    perturb(world, 2, 0.2);
    SolveOptions options;
    options.method = method;
    const SolveSummary summary = solve(world.graph, options);
    EXPECT_TRUE(summary.converged) << summary.reason;
    EXPECT_LT(worstError(world), 1e-7);
  }
}

TEST(Solver, RobustLossesHoldAgainstOutliersWhereNoneIsBent) {
  World2 clean = gridWorld(200, 3, {0.01, 0.01, 0.005});
  const World2 start = clean;
  solve(clean.graph);
  const auto bentBy = [&](const Loss& loss) {
    World2 world = start;
    for (int i = 10; i < 60; i += 10)
      world.graph.addFactor({{world.ids[i], world.ids[i + 100]},
                             std::make_shared<BetweenSe2>(Se2{5, 5, 1}),
                             SquareRootInformation::fromSigmas(Eigen::Vector3d(0.01, 0.01, 0.005)),
                             loss});
    const SolveSummary summary = solve(world.graph);
    EXPECT_TRUE(summary.converged) << summary.reason;
    double worst = 0;
    for (const VariableId id : world.ids)
      worst = std::max(worst, (world.graph.value(id) - clean.graph.value(id)).head<2>().norm());
    return worst;
  };
  EXPECT_GT(bentBy(Loss::none()), 3);
  EXPECT_LT(bentBy(Loss::huber(1)), 3);
  EXPECT_LT(bentBy(Loss::cauchy(1)), 0.02);
  EXPECT_LT(bentBy(Loss::tukey(4)), 1e-4);
}

TEST(Solver, ReachesTheCostThatCeresReaches) {
  World2 world = gridWorld(300, 20, {0.05, 0.05, 0.02});
  Noise noise(21);
  for (int i = 0; i < 20; ++i)
    world.graph.addFactor({{world.ids[10 * i], world.ids[299 - 5 * i]},
                           std::make_shared<BetweenSe2>(noise.se2()),
                           SquareRootInformation::fromSigmas(Eigen::Vector3d(0.05, 0.05, 0.02)),
                           i % 2 ? Loss::cauchy(2) : Loss::huber(1.5),
                           i % 3 ? 1.0 : 0.7});
  std::map<VariableId, Eigen::Vector3d> values;
  for (const VariableId id : world.ids) values[id] = world.graph.value(id);
  ceres::Problem problem;
  for (const auto& [id, record] : world.graph.factors()) {
    ceres::LossFunction* loss = nullptr;
    if (record.loss.kind() == Loss::Kind::cauchy) loss = new ceres::CauchyLoss(record.loss.scale());
    if (record.loss.kind() == Loss::Kind::huber) loss = new ceres::HuberLoss(record.loss.scale());
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<GridEdge, 3, 3, 3>(new GridEdge{
            dynamic_cast<const BetweenSe2&>(*record.factor).measured(), Eigen::Matrix3d(record.noise.matrix())}),
        new ceres::ScaledLoss(loss, record.weight, ceres::TAKE_OWNERSHIP), values[record.variables[0]].data(),
        values[record.variables[1]].data());
  }
  problem.SetParameterBlockConstant(values[world.ids[0]].data());
  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  ceres_options.max_num_iterations = 500;
  ceres_options.function_tolerance = 1e-12;
  ceres::Solver::Summary theirs;
  ceres::Solve(ceres_options, &problem, &theirs);
  ASSERT_EQ(theirs.termination_type, ceres::CONVERGENCE) << theirs.message;
  for (const auto method : kMethods) {
    World2 ours = world;
    SolveOptions options;
    options.method = method;
    const SolveSummary summary = solve(ours.graph, options);
    EXPECT_TRUE(summary.converged) << summary.reason;
    EXPECT_NEAR(summary.initial_cost, theirs.initial_cost, 1e-9 * theirs.initial_cost);
    EXPECT_NEAR(summary.final_cost, theirs.final_cost, 1e-6 * theirs.final_cost);
    EXPECT_NEAR(summary.final_cost, ours.graph.cost(), 1e-9 * summary.final_cost);
  }
}

TEST(Solver, FixedVariablesAndThoseNothingBindsStay) {
  World2 world = gridWorld(50, 4, {0.1, 0.1, 0.05});
  perturb(world, 5, 0.1);
  const VariableId alone = world.graph.addVariable(point2(), Eigen::Vector2d(1, 2));
  world.graph.setFixed(world.ids[20], true);
  const Eigen::VectorXd before = world.graph.value(world.ids[20]);
  solve(world.graph);
  EXPECT_EQ(world.graph.value(world.ids[20]), before);
  EXPECT_EQ(world.graph.value(world.ids[0]), toValue(world.truth[0]));
  EXPECT_EQ(world.graph.value(alone), Eigen::Vector2d(1, 2));
}

TEST(Solver, AnUnconstrainedGraphIsRefusedByName) {
  World2 world = gridWorld(10, 6, {0.1, 0.1, 0.05});
  world.graph.setFixed(world.ids[0], false);
  EXPECT_THROW(solve(world.graph), base::Error);
  world.graph.addFactor(
      {{world.ids[4]}, std::make_shared<PriorSe2>(world.truth[4]), SquareRootInformation::identity(3)});
  EXPECT_TRUE(solve(world.graph).converged);
  // A second part of the graph, tied to the first by a factor of weight 0 only.
  const VariableId a = world.graph.addVariable(se2(), toValue(Se2{}));
  FactorRecord idle{{world.ids[1], a}, std::make_shared<BetweenSe2>(Se2{}), SquareRootInformation::identity(3)};
  idle.weight = 0;
  const FactorId tie = world.graph.addFactor(idle);
  EXPECT_TRUE(solve(world.graph).converged);
  const VariableId b = world.graph.addVariable(se2(), toValue(Se2{}));
  world.graph.addFactor({{a, b}, std::make_shared<BetweenSe2>(Se2{}), SquareRootInformation::identity(3)});
  EXPECT_THROW(solve(world.graph), base::Error);
  world.graph.setWeight(tie, 1);
  EXPECT_TRUE(solve(world.graph).converged);
}

TEST(Solver, RemovalAndWeightZeroEqualAGraphBuiltWithout) {
  World2 plain = gridWorld(100, 7, {0.1, 0.1, 0.05});
  World2 removed = plain, idle = plain;
  std::vector<FactorId> extra;
  for (int i = 0; i < 5; ++i) {
    const FactorRecord wrong{{removed.ids[10 * i], removed.ids[90 - i]},
                             std::make_shared<BetweenSe2>(Se2{1, 1, 1}),
                             SquareRootInformation::identity(3)};
    extra.push_back(removed.graph.addFactor(wrong));
    idle.graph.addFactor(wrong);
  }
  for (const FactorId id : extra) {
    removed.graph.removeFactor(id);
    idle.graph.setWeight(id, 0);
  }
  solve(plain.graph);
  solve(removed.graph);
  solve(idle.graph);
  for (const VariableId id : plain.ids) {
    EXPECT_EQ(removed.graph.value(id), plain.graph.value(id));
    EXPECT_EQ(idle.graph.value(id), plain.graph.value(id));
  }
}

TEST(Solver, AWeightOfTwoIsTheFactorTwice) {
  World2 weighted = gridWorld(60, 8, {0.1, 0.1, 0.05});
  World2 twice = weighted;
  const FactorId loop = std::prev(weighted.graph.factorsOf(weighted.ids[59]).end())[0];
  weighted.graph.setWeight(loop, 2);
  weighted.graph.setLoss(loop, Loss::huber(1));
  twice.graph.setLoss(loop, Loss::huber(1));
  twice.graph.addFactor(twice.graph.factor(loop));
  solve(weighted.graph);
  solve(twice.graph);
  for (const VariableId id : weighted.ids) EXPECT_LT((weighted.graph.value(id) - twice.graph.value(id)).norm(), 1e-6);
}

TEST(Solver, PlanarPosesSolveFactorsOfSpaceAsTheirPlanarPart) {
  World2 world = gridWorld(80, 9, {0.05, 0.05, 0.02});
  perturb(world, 10, 0.1);
  Graph lifted;
  for (std::size_t i = 0; i < world.ids.size(); ++i) lifted.addVariable(se2(), world.graph.value(world.ids[i]), i == 0);
  for (const auto& [id, record] : world.graph.factors()) {
    const auto& planar = dynamic_cast<const BetweenSe2&>(*record.factor);
    lifted.addFactor(
        {record.variables, std::make_shared<BetweenSe3>(geometry::lift(planar.measured())),
         SquareRootInformation::fromSigmas((geometry::Vector6d() << 0.05, 0.05, 0.1, 0.1, 0.1, 0.02).finished())});
  }
  solve(world.graph);
  solve(lifted);
  EXPECT_NEAR(lifted.cost(), world.graph.cost(), 1e-9 * world.graph.cost());
  for (const VariableId id : world.ids) EXPECT_LT((lifted.value(id) - world.graph.value(id)).norm(), 1e-5);
}

TEST(Solver, SameGraphSameBits) {
  World3 first = sphereWorld(5, 10, 11, 0.05, 0.02);
  perturb(first, 12, 0.1);
  World3 second = first;
  solve(first.graph);
  solve(second.graph);
  for (const VariableId id : first.ids) EXPECT_EQ(first.graph.value(id), second.graph.value(id));
}

TEST(Solver, StopsOnRequestWithTheBestSoFar) {
  World2 world = gridWorld(100, 13, {0.1, 0.1, 0.05});
  perturb(world, 14, 0.3);
  SolveOptions options;
  int asked = 0;
  options.stop = [&] { return ++asked == 2; };
  const SolveSummary summary = solve(world.graph, options);
  EXPECT_FALSE(summary.converged);
  EXPECT_EQ(summary.reason, "stopped on request");
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST(Solver, SaysWhenTheIterationsRunOut) {
  World2 world = gridWorld(100, 15, {0.1, 0.1, 0.05});
  perturb(world, 16, 0.3);
  SolveOptions options;
  options.max_iterations = 1;
  const SolveSummary summary = solve(world.graph, options);
  EXPECT_FALSE(summary.converged);
  EXPECT_EQ(summary.iterations, 1);
  EXPECT_FALSE(summary.reason.empty());
}

TEST(Solver, AnEmptyGraphIsSolved) {
  Graph graph;
  EXPECT_TRUE(solve(graph).converged);
  graph.addVariable(se2(), toValue(Se2{}), true);
  EXPECT_TRUE(solve(graph).converged);
}

}  // namespace
}  // namespace omnimapper::graph::solver_test

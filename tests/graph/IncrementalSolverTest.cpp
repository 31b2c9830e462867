#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Solver.h>

#include <algorithm>

#include "Worlds.h"
#include "omnimapper/graph/IncrementalSolver.h"

namespace omnimapper::graph::incremental_solver_test {
namespace {

using base::FactorId;
using base::VariableId;

/// The factors of a graph by the last of their variables, as a run would add them.
std::map<VariableId, std::vector<FactorId>> byLastVariable(const Graph& graph) {
  std::map<VariableId, std::vector<FactorId>> factors;
  for (const auto& [id, record] : graph.factors())
    factors[*std::max_element(record.variables.begin(), record.variables.end())].push_back(id);
  return factors;
}

template <class Pose>
void disturb(World<Pose>& world, Noise& noise, double size) {
  for (std::size_t i = 1; i < world.ids.size(); ++i) {
    const auto tangent = Eigen::VectorXd::Constant(world.graph.variable(world.ids[i]).kind->tangentSize(), size);
    world.graph.setValue(world.ids[i], toValue(plus(world.truth[i], noise.normals(tangent))));
  }
}

/// The estimate is at the minimum that the batch solver finds from it.
void expectBatchMinimum(const IncrementalSolver& solver, Graph graph) {
  solver.store(graph);
  const double cost = graph.cost();
  const SolveSummary batch = solve(graph);
  EXPECT_NEAR(cost, batch.final_cost, 1e-7 * batch.final_cost + 1e-12);
  for (const auto& [id, record] : graph.variables()) {
    if (!solver.contains(id)) continue;
    EXPECT_LT((solver.value(id) - record.value).lpNorm<Eigen::Infinity>(), 2e-4) << id;
  }
}

template <class Pose>
void expectGrowthEndsAtBatchMinimum(World<Pose> world) {
  Noise noise(7);
  disturb(world, noise, 0.02);
  IncrementalSolver solver;
  for (const auto& [last, factors] : byLastVariable(world.graph)) solver.update(world.graph, {factors, {}, {}, {}});
  Graph before = world.graph, now = world.graph;
  solver.store(now);
  const double minimum = solve(before).final_cost;
  EXPECT_LT(now.cost(), 1.01 * minimum) << "without any step but those of the growth";
  EXPECT_TRUE(solver.converge());
  expectBatchMinimum(solver, world.graph);
}

TEST(IncrementalSolver, GrowsWithATownToTheBatchMinimum) {
  expectGrowthEndsAtBatchMinimum(gridWorld(300, 1, {0.02, 0.02, 0.01}));
}

TEST(IncrementalSolver, GrowsWithASphereToTheBatchMinimum) {
  expectGrowthEndsAtBatchMinimum(sphereWorld(6, 12, 2, 0.02, 0.01));
}

TEST(IncrementalSolver, LooksAtAllThatMovedSinceItLookedLast) {
  World2 world = gridWorld(300, 1, {0.02, 0.02, 0.01});
  Noise noise(7);
  disturb(world, noise, 0.1);
  IncrementalSolver each({0.01, 1, 0}), seldom({0.01, 7, 0});
  for (const auto& [last, factors] : byLastVariable(world.graph))
    for (IncrementalSolver* solver : {&each, &seldom}) solver->update(world.graph, {factors, {}, {}, {}});
  for (int i = 0; i < 14; ++i) seldom.update(world.graph, {});
  Graph minimum = world.graph, found = world.graph;
  seldom.store(found);
  solve(minimum);
  EXPECT_LT(found.cost(), 1.01 * minimum.cost()) << "of what moved between the looks, some is linearized where it was";
}

TEST(IncrementalSolver, TouchesOnlyWhatAChangeAffects) {
  World2 world = gridWorld(400, 3, {0.02, 0.02, 0.01});
  IncrementalSolver solver;
  std::size_t few = 0;
  for (const auto& [last, factors] : byLastVariable(world.graph))
    few += solver.update(world.graph, {factors, {}, {}, {}}).eliminated <= 60 ? 1u : 0u;
  EXPECT_GT(few, 300u);
}

/// A graph and a solver that follows it, changed at random.
struct RandomEdits {
  explicit RandomEdits(unsigned seed) : noise(seed), world(gridWorld(120, seed, {0.02, 0.02, 0.01})) {
    disturb(world, noise, 0.02);
    for (const auto& [id, record] : world.graph.factors()) changes.added.push_back(id);
    apply();
  }
  void apply() {
    solver.update(world.graph, changes);
    changes = {};
  }
  VariableId anyPose() { return world.ids[static_cast<std::size_t>(noise.below(static_cast<int>(world.ids.size())))]; }
  void addEdge() {
    const VariableId a = anyPose(), b = anyPose();
    if (a == b) return;
    const Se2 measured =
        plus(inverse(world.truth[a.index]) * world.truth[b.index], noise.normals(Eigen::Vector3d(0.05, 0.05, 0.03)));
    extra.push_back(world.graph.addFactor({{a, b},
                                           std::make_shared<BetweenSe2>(measured),
                                           SquareRootInformation::fromSigmas(Eigen::Vector3d(0.05, 0.05, 0.03)),
                                           noise.below(3) == 0 ? Loss::cauchy(1) : Loss::none()}));
    changes.added.push_back(extra.back());
  }
  void addPoint() {
    const VariableId point = world.graph.addVariable(point2(), Eigen::Vector2d(noise.uniform(8), noise.uniform(8)));
    for (int i = 0; i < 3; ++i) {
      const VariableId pose = anyPose();
      const Eigen::Vector2d seen = inverse(world.truth[pose.index]).rotation() *
                                   (world.graph.value(point) - world.truth[pose.index].translation());
      extra.push_back(world.graph.addFactor({{pose, point},
                                             std::make_shared<PointFactor2>(seen),
                                             SquareRootInformation::fromSigmas(Eigen::Vector2d(0.1, 0.1))}));
      changes.added.push_back(extra.back());
    }
  }
  void removeOne() {
    if (extra.empty()) return;
    const auto at = static_cast<std::size_t>(noise.below(static_cast<int>(extra.size())));
    const FactorId id = extra[at];
    extra.erase(extra.begin() + static_cast<std::ptrdiff_t>(at));
    world.graph.removeFactor(id);
    const auto added = std::find(changes.added.begin(), changes.added.end(), id);
    if (added != changes.added.end())
      changes.added.erase(added);
    else
      changes.removed.push_back(id);
    changes.changed.erase(std::remove(changes.changed.begin(), changes.changed.end(), id), changes.changed.end());
  }
  void reweigh() {
    if (extra.empty()) return;
    const FactorId id = extra[static_cast<std::size_t>(noise.below(static_cast<int>(extra.size())))];
    world.graph.setWeight(id, noise.below(3) == 0 ? 0 : 0.5 + noise.below(4));
    const bool is_listed = std::count(changes.added.begin(), changes.added.end(), id) +
                               std::count(changes.changed.begin(), changes.changed.end(), id) >
                           0;
    if (!is_listed) changes.changed.push_back(id);
  }

  Noise noise;
  World2 world;
  IncrementalSolver solver;
  GraphChanges changes;
  std::vector<FactorId> extra;
};

TEST(IncrementalSolver, RandomEditsEndWhereBatchEnds) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    RandomEdits edits(seed);
    for (int round = 0; round < 12; ++round) {
      for (int i = 0; i < 4; ++i) {
        const int kind = edits.noise.below(5);
        if (kind <= 1) edits.addEdge();
        if (kind == 2) edits.addPoint();
        if (kind == 3) edits.removeOne();
        if (kind == 4) edits.reweigh();
      }
      edits.apply();
      if (round % 3 != 2) continue;
      EXPECT_TRUE(edits.solver.converge(1e-7, 300)) << "seed " << seed << ", round " << round;
      expectBatchMinimum(edits.solver, edits.world.graph);
    }
  }
}

TEST(IncrementalSolver, CovariancesAreThoseOfTheWholeSystem) {
  RandomEdits edits(9);
  for (int i = 0; i < 6; ++i) edits.addEdge();
  for (int i = 0; i < 3; ++i) edits.addPoint();
  edits.apply();
  ASSERT_TRUE(edits.solver.converge(1e-9, 300));
  edits.solver.store(edits.world.graph);
  const Marginals marginals(edits.world.graph);
  std::vector<VariableId> ids{edits.world.ids[119], edits.world.ids[3], edits.world.ids[60], edits.world.ids[60]};
  ids.push_back(edits.world.graph.factor(edits.extra.back()).variables[1]);
  const Eigen::MatrixXd expected = marginals.jointCovariance(ids),
                        found = edits.solver.marginals(edits.world.graph).jointCovariance(ids);
  EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
  const Marginals by_tree = edits.solver.marginals(edits.world.graph);
  const auto cross = by_tree.crossCovariances(ids[0], ids), whole = marginals.crossCovariances(ids[0], ids);
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_LT((cross[i] - whole[i]).norm(), 1e-6 * expected.norm());
  EXPECT_TRUE(by_tree.contains(edits.world.ids[0])) << "it is fixed";
  EXPECT_EQ(by_tree.covariance(edits.world.ids[0]).norm(), 0);
  // The tree goes on; what was taken from it stays.
  const Eigen::MatrixXd of_one = by_tree.covariance(ids[2]);
  for (int i = 0; i < 6; ++i) edits.addEdge();
  edits.apply();
  EXPECT_EQ(by_tree.covariance(ids[2]), of_one);
  EXPECT_LT((by_tree.jointCovariance(ids) - expected).norm(), 1e-6 * expected.norm());
}

TEST(IncrementalSolver, TheSameUpdatesGiveTheSameBits) {
  const auto run = [] {
    RandomEdits edits(4);
    for (int i = 0; i < 10; ++i) {
      edits.addEdge();
      if (i % 3 == 0) edits.removeOne();
      edits.apply();
    }
    edits.solver.store(edits.world.graph);
    std::vector<double> numbers;
    for (const auto& [id, record] : edits.world.graph.variables())
      numbers.insert(numbers.end(), record.value.begin(), record.value.end());
    return numbers;
  };
  EXPECT_EQ(run(), run());
}

TEST(IncrementalSolver, WhatIsNotHeldIsNamedAndCanBeTakenBack) {
  World2 world = gridWorld(20, 1, {0.02, 0.02, 0.01});
  IncrementalSolver solver;
  GraphChanges all;
  for (const auto& [id, record] : world.graph.factors()) all.added.push_back(id);
  solver.update(world.graph, all);
  const VariableId a = world.graph.addVariable(se2(), Eigen::Vector3d(1, 2, 0)),
                   b = world.graph.addVariable(se2(), Eigen::Vector3d(2, 2, 0));
  const FactorId floating = world.graph.addFactor({{a, b},
                                                   std::make_shared<BetweenSe2>(Se2{1.1, 0, 0.1}),
                                                   SquareRootInformation::fromSigmas(Eigen::Vector3d(0.1, 0.1, 0.1))});
  try {
    solver.update(world.graph, {{floating}, {}, {}, {}});
    FAIL() << "two poses that nothing holds were solved";
  } catch (const base::Error& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.find(toString(a)) != std::string::npos || message.find(toString(b)) != std::string::npos)
        << message;
  }
  EXPECT_FALSE(solver.contains(world.ids[5]));
  world.graph.removeFactor(floating);
  solver.update(world.graph, {{}, {floating}, {}, {}});
  EXPECT_TRUE(solver.contains(world.ids[5]));
  EXPECT_FALSE(solver.contains(a));
  EXPECT_TRUE(solver.converge());
  expectBatchMinimum(solver, world.graph);
}

TEST(IncrementalSolver, WrongChangesAreRefusedBeforeAnythingChanges) {
  World2 world = gridWorld(20, 1, {0.02, 0.02, 0.01});
  IncrementalSolver solver;
  GraphChanges all;
  for (const auto& [id, record] : world.graph.factors()) all.added.push_back(id);
  solver.update(world.graph, all);
  const Eigen::VectorXd before = solver.value(world.ids[7]);
  EXPECT_THROW(solver.update(world.graph, {{all.added[3]}, {}, {}, {}}), base::Error);
  EXPECT_THROW(solver.update(world.graph, {{FactorId{0, 4000}}, {all.added[2]}, {}, {}}), base::Error);
  EXPECT_THROW(solver.update(world.graph, {{}, {all.added[2]}, {FactorId{0, 4000}}, {}}), base::Error);
  EXPECT_EQ(solver.value(world.ids[7]), before);
  EXPECT_THROW(solver.value(world.ids[0]), base::Error) << "the first pose is fixed";
  EXPECT_THROW(solver.marginals(world.graph).jointCovariance({VariableId{3, 3}}), base::Error);
}

TEST(IncrementalSolver, AFixedVariableIsFreedWhereItsFactorsAreChanged) {
  World2 world = gridWorld(40, 5, {0.02, 0.02, 0.01});
  IncrementalSolver solver;
  GraphChanges changes;
  for (const auto& [id, record] : world.graph.factors()) changes.added.push_back(id);
  world.graph.setFixed(world.ids[20], true);
  solver.update(world.graph, changes);
  EXPECT_FALSE(solver.contains(world.ids[20]));
  world.graph.setFixed(world.ids[20], false);
  changes = {};
  changes.changed = world.graph.factorsOf(world.ids[20]);
  solver.update(world.graph, changes);
  EXPECT_TRUE(solver.contains(world.ids[20]));
  EXPECT_TRUE(solver.converge());
  expectBatchMinimum(solver, world.graph);
}

TEST(IncrementalSolver, ManyFactorsMayBindOneVariable) {
  Graph graph;
  const VariableId hub = graph.addVariable(se2(), Eigen::Vector3d::Zero());
  const VariableId root = graph.addVariable(se2(), Eigen::Vector3d::Zero(), true);
  IncrementalSolver solver;
  Noise noise(1);
  GraphChanges changes;
  for (int i = 0; i < 10'000; ++i)
    changes.added.push_back(graph.addFactor(
        {{root, hub},
         std::make_shared<BetweenSe2>(plus(Se2{3, 4, 1}, noise.normals(Eigen::Vector3d(0.1, 0.1, 0.1)))),
         SquareRootInformation::fromSigmas(Eigen::Vector3d(0.1, 0.1, 0.1))}));
  solver.update(graph, changes);
  EXPECT_TRUE(solver.converge());
  expectBatchMinimum(solver, graph);
  EXPECT_NEAR(solver.marginals(graph).jointCovariance({hub}).trace(), 3 * 0.01 / 10'000, 1e-8);
}

}  // namespace
}  // namespace omnimapper::graph::incremental_solver_test

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>

#include "Worlds.h"
#include "omnimapper/graph/IncrementalSmoother.h"

namespace omnimapper::graph::incremental_smoother_test {
namespace {

using base::FactorId;
using base::VariableId;

SquareRootInformation sigmas(double position, double yaw) {
  return SquareRootInformation::fromSigmas(Eigen::Vector3d(position, position, yaw));
}

/// Edits a graph as a run does, with whatever kind of edit there is.
struct AnyEdits {
  explicit AnyEdits(unsigned seed) : noise(seed), world(gridWorld(100, seed, {0.02, 0.02, 0.01})), graph(world.graph) {}

  VariableId anyPose() { return world.ids[static_cast<std::size_t>(noise.below(static_cast<int>(world.ids.size())))]; }
  FactorId any() { return extra[static_cast<std::size_t>(noise.below(static_cast<int>(extra.size())))]; }
  void add() {
    const VariableId a = anyPose(), b = anyPose();
    if (a == b) return;
    // One of four is wrong, which its robust loss must find out.
    const double size = noise.below(4) == 0 ? 1 : 0.03;
    const Se2 measured = plus(inverse(world.truth[a.index]) * world.truth[b.index],
                              noise.normals(Eigen::Vector3d(size, size, size / 2)));
    extra.push_back(
        graph.addFactor({{a, b}, std::make_shared<BetweenSe2>(measured), sigmas(0.03, 0.02), Loss::cauchy(2)}));
  }
  void edit() {
    if (extra.empty()) return add();
    switch (noise.below(8)) {
      case 0: {
        const FactorId id = any();
        extra.erase(std::find(extra.begin(), extra.end(), id));
        return graph.removeFactor(id);
      }
      case 1:
        return graph.setWeight(any(), noise.below(2));
      case 2:
        return graph.setLoss(any(), noise.below(2) == 0 ? Loss::none() : Loss::huber(1.5));
      case 3: {
        const FactorId id = any();
        const VariableId a = anyPose(), b = anyPose();
        return a == b ? add() : graph.rebind(id, {a, b});
      }
      case 4: {
        const VariableId id = anyPose();
        return graph.setValue(id, graph.value(id) + noise.normals(Eigen::Vector3d(0.02, 0.02, 0.01)));
      }
      case 5: {
        const VariableId id = anyPose();
        return id == world.ids[0] ? add() : graph.setFixed(id, !graph.variable(id).fixed);
      }
      default:
        return add();
    }
  }

  Noise noise;
  World2 world;
  Graph graph;
  std::vector<FactorId> extra;
};

TEST(IncrementalSmoother, SeesEveryKindOfEditAndStaysNearTheMinimum) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    AnyEdits edits(seed);
    IncrementalSmoother smoother;
    for (int round = 0; round < 15; ++round) {
      for (int i = 0; i < 5; ++i) edits.edit();
      if (round % 2 == 0) smoother.follow(edits.graph);
      const double before = edits.graph.cost();
      smoother.minimize(edits.graph, {});
      EXPECT_LE(edits.graph.cost(), before + 0.01);
      // From where the smoother ended, so that both are in the valley of one minimum.
      Graph batch = edits.graph;
      solve(batch);
      EXPECT_LT(edits.graph.cost(), 1.02 * batch.cost() + 1e-9) << "seed " << seed << ", round " << round;
    }
  }
}

TEST(IncrementalSmoother, AnEditOfOnePlaceWritesFewValues) {
  World2 world = gridWorld(300, 3, {0.02, 0.02, 0.01});
  IncrementalSmoother smoother;
  smoother.minimize(world.graph, {});
  const Graph before = world.graph;
  const VariableId last = world.ids.back();
  const VariableId next = world.graph.addVariable(se2(), world.graph.value(last));
  world.graph.addFactor({{last, next}, std::make_shared<BetweenSe2>(Se2{1, 0, 0}), sigmas(0.02, 0.01)});
  smoother.minimize(world.graph, {});
  EXPECT_LE(changesBetween(before, world.graph).moved.size(), 20U);
  EXPECT_NEAR((world.graph.value(next) - world.graph.value(last)).head<2>().norm(), 1, 1e-6);
}

TEST(IncrementalSmoother, WhatIsNotDeterminedYetIsSolvedAsAWhole) {
  World2 world = gridWorld(30, 2, {0.02, 0.02, 0.01});
  IncrementalSmoother smoother;
  smoother.minimize(world.graph, {});
  // A point that is seen by its distance to a line of sight alone: its distance along that is open.
  Eigen::Matrix2d weak = Eigen::Matrix2d::Identity();
  weak(0, 0) = 1e-12;
  const VariableId point = world.graph.addVariable(point2(), Eigen::Vector2d(3, 3));
  world.graph.addFactor({{world.ids[4], point},
                         std::make_shared<PointFactor2>(Eigen::Vector2d(1, 1)),
                         SquareRootInformation::fromMatrix(weak)});
  EXPECT_NO_THROW(smoother.follow(world.graph));
  const double before = world.graph.cost();
  smoother.minimize(world.graph, {});
  EXPECT_LE(world.graph.cost(), before);
  // It is seen from elsewhere, and all is followed again.
  world.graph.addFactor({{world.ids[20], point},
                         std::make_shared<PointFactor2>(Eigen::Vector2d(1, 1)),
                         SquareRootInformation::fromSigmas(Eigen::Vector2d(0.1, 0.1))});
  smoother.minimize(world.graph, {});
  Graph batch = world.graph;
  solve(batch);
  EXPECT_LT(world.graph.cost(), 1.02 * batch.cost() + 1e-9);
}

TEST(IncrementalSmoother, APartThatNothingHoldsIsRefusedByName) {
  World2 world = gridWorld(30, 2, {0.02, 0.02, 0.01});
  const VariableId a = world.graph.addVariable(se2(), Eigen::Vector3d(1, 2, 0)),
                   b = world.graph.addVariable(se2(), Eigen::Vector3d(2, 2, 0));
  const FactorId floating =
      world.graph.addFactor({{a, b}, std::make_shared<BetweenSe2>(Se2{1.1, 0, 0.1}), sigmas(0.1, 0.1)});
  IncrementalSmoother smoother;
  try {
    smoother.minimize(world.graph, {});
    FAIL() << "two poses that nothing holds were solved";
  } catch (const base::Error& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.find(toString(a)) != std::string::npos || message.find(toString(b)) != std::string::npos)
        << message;
  }
  world.graph.removeFactor(floating);
  EXPECT_NO_THROW(smoother.minimize(world.graph, {}));
}

TEST(IncrementalSmoother, ABadStartIsSolvedAsAWhole) {
  World2 world = gridWorld(150, 4, {0.02, 0.02, 0.01});
  Noise noise(5);
  for (std::size_t i = 1; i < world.ids.size(); ++i)
    world.graph.setValue(world.ids[i], world.graph.value(world.ids[i]) + noise.normals(Eigen::Vector3d(3, 3, 0.8)));
  Graph batch = world.graph;
  solve(batch);
  IncrementalSmoother smoother;
  smoother.minimize(world.graph, {});
  EXPECT_LE(world.graph.cost(), 1.02 * batch.cost());
}

TEST(IncrementalSmoother, ARobustLossIsWeighedAsTheEstimateMoves) {
  // A pose between two priors: near ones by three measurements, and a far one that its loss must let go.
  Graph graph;
  const VariableId pose = graph.addVariable(se2(), Eigen::Vector3d(0, 0, 0));
  const auto prior = [&](double x, Loss loss) {
    graph.addFactor({{pose}, std::make_shared<PriorSe2>(Se2{x, 0, 0}), sigmas(0.001, 0.001), loss});
  };
  prior(0, Loss::none());
  IncrementalSmoother smoother;
  smoother.minimize(graph, {});
  for (const double x : {0.010, 0.011, 0.012, 0.013}) {
    prior(x, Loss::cauchy(1));
    smoother.follow(graph);
  }
  smoother.minimize(graph, {});
  Graph batch = graph;
  solve(batch);
  EXPECT_LT(graph.cost(), 1.01 * batch.cost())
      << graph.value(pose)[0] << " m, but " << batch.value(pose)[0] << " m at the minimum";
}

TEST(IncrementalSmoother, TheSameEditsGiveTheSameBits) {
  const auto run = [] {
    AnyEdits edits(11);
    IncrementalSmoother smoother;
    for (int i = 0; i < 40; ++i) {
      edits.edit();
      smoother.follow(edits.graph);
      if (i % 4 == 3) smoother.minimize(edits.graph, {});
    }
    std::vector<double> numbers;
    for (const auto& [id, record] : edits.graph.variables())
      numbers.insert(numbers.end(), record.value.begin(), record.value.end());
    return numbers;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace omnimapper::graph::incremental_smoother_test

#include <gtest/gtest.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/Solver.h>

#include "Worlds.h"
#include "omnimapper/graph/Initialization.h"

namespace omnimapper::graph::initialization_test {
namespace {

using base::VariableId;

template <class Pose>
void forget(World<Pose>& world) {
  for (std::size_t i = 1; i < world.ids.size(); ++i) world.graph.setValue(world.ids[i], toValue(Pose{}));
}

template <class Pose>
double worstError(const World<Pose>& world) {
  double worst = 0;
  for (std::size_t i = 0; i < world.ids.size(); ++i)
    worst = std::max(worst, minus(poseOf<Pose>(world.graph, world.ids[i]), world.truth[i]).norm());
  return worst;
}

template <class Pose>
void expectExactStarts(World<Pose> world) {
  World<Pose> chained = world;
  forget(world);
  forget(chained);
  initializeByChaining(chained.graph);
  EXPECT_LT(worstError(chained), 1e-7);
  initializeRotationsFirst(world.graph);
  EXPECT_LT(worstError(world), 1e-7);
}

TEST(Initialization, IsExactWhereTheMeasurementsAre) {
  expectExactStarts(gridWorld(300, 1, {1e-12, 1e-12, 1e-12}));
  expectExactStarts(sphereWorld(8, 12, 1, 1e-12, 1e-12));
}

/// The cost that solve() reaches from the truth.
template <class Pose>
double costFromTruth(const World<Pose>& world) {
  Graph graph = world.graph;
  EXPECT_TRUE(solve(graph).converged);
  return graph.cost();
}

TEST(Initialization, ANoisyTownIsSolvedFromEitherStart) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    World2 world = gridWorld(1500, seed, {0.05, 0.05, 0.02});
    const double best = costFromTruth(world);
    initializeByChaining(world.graph);
    const double chained = world.graph.cost();
    EXPECT_GT(chained, 10 * best);
    EXPECT_TRUE(solve(world.graph).converged);
    EXPECT_NEAR(world.graph.cost(), best, 1e-6 * best) << "chained, seed " << seed;
    forget(world);
    initializeRotationsFirst(world.graph);
    EXPECT_LT(world.graph.cost(), 0.1 * chained);
    EXPECT_TRUE(solve(world.graph).converged);
    EXPECT_NEAR(world.graph.cost(), best, 1e-6 * best) << "rotations first, seed " << seed;
  }
}

TEST(Initialization, ANoisyBallIsSolvedFromEitherStart) {
  for (const unsigned seed : {1u, 2u}) {
    World3 world = sphereWorld(15, 30, seed, 0.1, 0.05);
    const double best = costFromTruth(world);
    initializeByChaining(world.graph);
    EXPECT_TRUE(solve(world.graph).converged);
    EXPECT_NEAR(world.graph.cost(), best, 1e-6 * best) << "chained, seed " << seed;
    forget(world);
    initializeRotationsFirst(world.graph);
    EXPECT_TRUE(solve(world.graph).converged);
    EXPECT_NEAR(world.graph.cost(), best, 1e-6 * best) << "rotations first, seed " << seed;
  }
}

TEST(Initialization, RotationsFirstFindsTheOptimumWhereOdometryIsLost) {
  // Half a radian of rotation noise: chained poses are anywhere.
  World3 world = sphereWorld(15, 30, 3, 0.1, 0.3);
  const double best = costFromTruth(world);
  forget(world);
  initializeRotationsFirst(world.graph);
  EXPECT_TRUE(solve(world.graph).converged);
  EXPECT_NEAR(world.graph.cost(), best, 1e-6 * best);
}

TEST(Initialization, FixedPosesStayAndPriorsHold) {
  World2 world = gridWorld(100, 4, {1e-6, 1e-6, 1e-6});
  forget(world);
  world.graph.setFixed(world.ids[0], false);
  world.graph.setValue(world.ids[0], toValue(Se2{50, 50, 1}));
  world.graph.addFactor({{world.ids[40]},
                         std::make_shared<PriorSe2>(world.truth[40]),
                         SquareRootInformation::fromSigmas(Eigen::Vector3d(1, 1, 1))});
  World2 chained = world;
  initializeRotationsFirst(world.graph);
  EXPECT_LT(worstError(world), 1e-3);
  initializeByChaining(chained.graph);
  EXPECT_LT(worstError(chained), 1e-3);
  chained.graph.setFixed(chained.ids[10], true);
  const Eigen::VectorXd before = chained.graph.value(chained.ids[10]);
  initializeRotationsFirst(chained.graph);
  EXPECT_EQ(chained.graph.value(chained.ids[10]), before);
}

TEST(Initialization, EachUnconstrainedPartStaysAtItsFirstPose) {
  World2 world = gridWorld(30, 5, {1e-9, 1e-9, 1e-9});
  world.graph.setFixed(world.ids[0], false);
  const Se2 far{100, 0, 2};
  const VariableId a = world.graph.addVariable(se2(), toValue(far));
  const VariableId b = world.graph.addVariable(se2(), toValue(Se2{}));
  world.graph.addFactor({{a, b}, std::make_shared<BetweenSe2>(Se2{1, 0, 0}), SquareRootInformation::identity(3)});
  for (const auto initialize : {initializeByChaining, initializeRotationsFirst}) {
    forget(world);
    world.graph.setValue(b, toValue(Se2{}));
    initialize(world.graph);
    EXPECT_LT(worstError(world), 1e-5);
    EXPECT_EQ(world.graph.value(a), toValue(far));
    EXPECT_LT((world.graph.value(b) - toValue(far * Se2{1, 0, 0})).norm(), 1e-12);
  }
}

TEST(Initialization, PointsAreSetToTheMeanOfWhatThePosesSaw) {
  Graph graph;
  const VariableId a = graph.addVariable(se2(), toValue(Se2{}), true);
  const VariableId b = graph.addVariable(se2(), toValue(Se2{9, 9, 9}));
  const VariableId point = graph.addVariable(point2(), Eigen::Vector2d(0, 0));
  const auto unit = SquareRootInformation::identity(2);
  graph.addFactor(
      {{a, b}, std::make_shared<BetweenSe2>(Se2{1, 0, geometry::kPi / 2}), SquareRootInformation::identity(3)});
  graph.addFactor({{a, point}, std::make_shared<PointFactor2>(Eigen::Vector2d(1, 2)), unit});
  graph.addFactor({{b, point}, std::make_shared<PointFactor2>(Eigen::Vector2d(2.2, 0)), unit});
  for (const auto initialize : {initializeByChaining, initializeRotationsFirst}) {
    graph.setValue(point, Eigen::Vector2d(0, 0));
    initialize(graph);
    EXPECT_LT((graph.value(point) - Eigen::Vector2d(1, 2.1)).norm(), 1e-14);
  }
}

TEST(Initialization, MixesPlanarAndSpatialPoses) {
  Graph graph;
  const VariableId a = graph.addVariable(se2(), toValue(Se2{1, 2, 0.5}), true);
  const VariableId b = graph.addVariable(se3(), toValue(Se3{}));
  const VariableId c = graph.addVariable(se2(), toValue(Se2{}));
  const Se3 a_from_b{geometry::expSo3({0.1, 0.2, 0.3}), {1, 2, 3}};
  const Se2 a_from_c{3, 0, 1};
  graph.addFactor({{a, b}, std::make_shared<BetweenSe3>(a_from_b), SquareRootInformation::identity(6)});
  graph.addFactor({{a, c}, std::make_shared<BetweenSe2>(a_from_c), SquareRootInformation::identity(3)});
  for (const auto initialize : {initializeByChaining, initializeRotationsFirst}) {
    graph.setValue(b, toValue(Se3{}));
    graph.setValue(c, toValue(Se2{}));
    initialize(graph);
    EXPECT_LT(minus(poseOf<Se3>(graph, b), geometry::lift(Se2{1, 2, 0.5}) * a_from_b).norm(), 1e-12);
    EXPECT_LT(minus(poseOf<Se2>(graph, c), Se2{1, 2, 0.5} * a_from_c).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace omnimapper::graph::initialization_test

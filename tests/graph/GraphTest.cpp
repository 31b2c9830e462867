#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>

#include "Worlds.h"
#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph::graph_test {
namespace {

using base::FactorId;
using base::VariableId;

FactorRecord odometry(VariableId a, VariableId b, const Se2& a_from_b) {
  return {{a, b}, std::make_shared<BetweenSe2>(a_from_b), SquareRootInformation::identity(3)};
}

/// Runs `edit` and gives the message of the Error it must throw.
template <class Edit>
std::string messageOf(const Edit& edit) {
  try {
    edit();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::internal);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Graph, IdsCarryTheSessionAndAreNeverGivenTwice) {
  Graph graph(7);
  const VariableId first = graph.addVariable(point2(), Eigen::Vector2d(0, 0));
  const VariableId second = graph.addVariable(point2(), Eigen::Vector2d(1, 1));
  EXPECT_EQ(toString(first), "7:0");
  EXPECT_EQ(toString(second), "7:1");
  graph.removeVariable(second);
  EXPECT_FALSE(graph.contains(second));
  EXPECT_EQ(toString(graph.addVariable(point2(), Eigen::Vector2d(2, 2))), "7:2");
  graph.setSession(9);
  EXPECT_EQ(toString(graph.addVariable(point2(), Eigen::Vector2d(2, 2))), "9:0");
}

TEST(Graph, IteratesInTheOrderOfIdsPastHolesAndSessions) {
  Graph graph(3);
  std::vector<VariableId> ids;
  for (int i = 0; i < 5; ++i) ids.push_back(graph.addVariable(point2(), Eigen::Vector2d(i, 0)));
  graph.setSession(1);
  const VariableId earlier = graph.addVariable(point2(), Eigen::Vector2d(9, 0));
  for (const int i : {0, 2, 4}) graph.removeVariable(ids[i]);
  std::vector<VariableId> seen;
  for (const auto& [id, record] : graph.variables()) {
    seen.push_back(id);
    EXPECT_EQ(record.value, graph.value(id));
  }
  EXPECT_EQ(seen, (std::vector<VariableId>{earlier, ids[1], ids[3]}));
  EXPECT_EQ(graph.variables().size(), 3u);
}

TEST(Graph, KnowsTheFactorsOfEachVariable) {
  Graph graph;
  const VariableId a = graph.addVariable(se2(), toValue(Se2{})), b = graph.addVariable(se2(), toValue(Se2{}));
  const FactorId first = graph.addFactor(odometry(a, b, {1, 0, 0}));
  const FactorId second = graph.addFactor(odometry(b, a, {-1, 0, 0}));
  EXPECT_EQ(graph.factorsOf(a), (std::vector<FactorId>{first, second}));
  graph.removeFactor(first);
  EXPECT_EQ(graph.factorsOf(a), std::vector<FactorId>{second});
  EXPECT_EQ(graph.factorsOf(b), std::vector<FactorId>{second});
  EXPECT_NE(messageOf([&] { graph.removeVariable(a); }).find(toString(second)), std::string::npos);
  graph.removeFactor(second);
  graph.removeVariable(a);
  EXPECT_EQ(graph.variables().size(), 1u);
}

TEST(Graph, RefusesFactorsThatDoNotFitAndSaysWhy) {
  Graph graph;
  const VariableId pose = graph.addVariable(se2(), toValue(Se2{}));
  const VariableId point = graph.addVariable(point2(), Eigen::Vector2d(1, 1));
  const auto between = std::make_shared<BetweenSe2>(Se2{});
  const auto unit = SquareRootInformation::identity(3);
  EXPECT_NE(messageOf([&] { graph.addFactor({{pose, point}, between, unit}); }).find("point2"), std::string::npos);
  EXPECT_NE(messageOf([&] { graph.addFactor({{pose}, between, unit}); }).find("2 variables"), std::string::npos);
  EXPECT_NE(messageOf([&] { graph.addFactor({{pose, pose}, between, unit}); }).find("twice"), std::string::npos);
  EXPECT_NE(messageOf([&] { graph.addFactor({{pose, {0, 99}}, between, unit}); }).find("0:99"), std::string::npos);
  const VariableId other = graph.addVariable(se2(), toValue(Se2{}));
  EXPECT_NE(messageOf([&] {
              graph.addFactor({{pose, other}, between, SquareRootInformation::identity(2)});
            }).find("3 rows"),
            std::string::npos);
  FactorRecord negative{{pose, other}, between, unit};
  negative.weight = -1;
  EXPECT_NE(messageOf([&] { graph.addFactor(negative); }).find("weight"), std::string::npos);
  EXPECT_TRUE(graph.factors().empty());
  EXPECT_TRUE(graph.factorsOf(pose).empty());
}

TEST(Graph, RefusesValuesThatDoNotFit) {
  Graph graph;
  const VariableId pose = graph.addVariable(se2(), toValue(Se2{}));
  EXPECT_THROW(graph.setValue(pose, Eigen::Vector2d(1, 2)), base::Error);
  EXPECT_THROW(graph.setValue(pose, Eigen::Vector3d(1, 2, std::nan(""))), base::Error);
  EXPECT_THROW(graph.addVariable(point3(), Eigen::Vector2d(1, 2)), base::Error);
  EXPECT_THROW(graph.value({0, 5}), base::Error);
  EXPECT_THROW(graph.removeFactor({0, 5}), base::Error);
  EXPECT_THROW(graph.setWeight({0, 5}, 1), base::Error);
}

TEST(Graph, CostCountsWeightAndLoss) {
  Graph graph;
  const VariableId a = graph.addVariable(se2(), toValue(Se2{})), b = graph.addVariable(se2(), toValue(Se2{3, 0, 0}));
  FactorRecord record = odometry(a, b, {1, 0, 0});
  record.noise = SquareRootInformation::fromSigmas(Eigen::Vector3d(0.5, 1, 1));
  const FactorId id = graph.addFactor(record);
  EXPECT_LT((graph.whitenedResidual(id) - Eigen::Vector3d(4, 0, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(graph.chi2(), 16);
  EXPECT_DOUBLE_EQ(graph.cost(), 8);
  graph.setWeight(id, 3);
  EXPECT_DOUBLE_EQ(graph.chi2(), 48);
  graph.setLoss(id, Loss::huber(1));
  EXPECT_DOUBLE_EQ(graph.chi2(), 48);
  EXPECT_DOUBLE_EQ(graph.cost(), 0.5 * 3 * (2 * 4 - 1));
  graph.setWeight(id, 0);
  EXPECT_EQ(graph.cost(), 0);
}

TEST(Graph, AFactorThatIsBoundAnewKeepsItsIdAndItsNoise) {
  Graph graph;
  const VariableId a = graph.addVariable(se2(), toValue(Se2{})), b = graph.addVariable(se2(), toValue(Se2{1, 0, 0}));
  const VariableId c = graph.addVariable(se2(), toValue(Se2{2, 0, 0})),
                   p = graph.addVariable(point2(), Eigen::Vector2d::Zero());
  const FactorId first = graph.addFactor(odometry(a, b, {1, 0, 0})),
                 second = graph.addFactor(odometry(b, c, {1, 0, 0}));
  graph.rebind(first, {a, c});
  EXPECT_EQ(graph.factor(first).variables, (std::vector{a, c}));
  EXPECT_EQ(graph.factorsOf(a), std::vector{first});
  EXPECT_EQ(graph.factorsOf(b), std::vector{second});
  EXPECT_EQ(graph.factorsOf(c), (std::vector{first, second}));
  EXPECT_THROW(graph.rebind(first, {a, a}), base::Error);
  EXPECT_THROW(graph.rebind(first, {a, p}), base::Error);
  EXPECT_EQ(graph.factor(first).variables, (std::vector{a, c})) << "as it was";
}

TEST(Graph, CopiesAreIndependent) {
  World2 world = gridWorld(20, 1, {0.1, 0.1, 0.05});
  Graph copy = world.graph;
  copy.setValue(world.ids[3], toValue(Se2{9, 9, 1}));
  copy.removeFactor({0, 0});
  EXPECT_EQ(world.graph.value(world.ids[3]), toValue(world.truth[3]));
  EXPECT_TRUE(world.graph.contains(FactorId{0, 0}));
}

TEST(Graph, LiftsPlanarPosesIntoFactorsOfSpace) {
  Noise noise(1);
  const Se2 a = noise.se2(), b = noise.se2();
  Graph graph;
  const VariableId ia = graph.addVariable(se2(), toValue(a)), ib = graph.addVariable(se2(), toValue(b));
  const VariableId ic = graph.addVariable(se3(), toValue(geometry::lift(b)));
  const VariableId point = graph.addVariable(point3(), Eigen::Vector3d(1, 2, 3));
  const auto between = std::make_shared<BetweenSe3>(noise.se3());
  const auto unit = SquareRootInformation::identity(6);
  const FactorId planar = graph.addFactor({{ia, ib}, between, unit});
  const FactorId mixed = graph.addFactor({{ia, ic}, between, unit});
  const FactorId seen = graph.addFactor(
      {{ia, point}, std::make_shared<PointFactor3>(Eigen::Vector3d(0, 0, 1)), SquareRootInformation::identity(3)});
  const geometry::Vector6d expected = geometry::minus(geometry::lift(inverse(a) * b), between->measured());
  EXPECT_LT((graph.whitenedResidual(planar) - expected).norm(), 1e-13);
  EXPECT_LT((graph.whitenedResidual(mixed) - expected).norm(), 1e-13);
  EXPECT_NEAR(graph.whitenedResidual(seen)[2], 2, 1e-14);
}

TEST(Graph, DoesNotTakeAPoseInSpaceForAPlanarOne) {
  Graph graph;
  const VariableId a = graph.addVariable(se3(), toValue(Se3{})), b = graph.addVariable(se3(), toValue(Se3{}));
  EXPECT_THROW(graph.addFactor(odometry(a, b, {1, 0, 0})), base::Error);
}

}  // namespace
}  // namespace omnimapper::graph::graph_test

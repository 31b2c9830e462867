#include <ceres/ceres.h>
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/Solver.h>

#include <Eigen/LU>

#include "GridEdge.h"
#include "Jacobians.h"
#include "Worlds.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph::marginals_test {
namespace {

using base::VariableId;

/// The inverse of the whole information matrix, built from scratch by finite differences; free variables in the order
/// of ids.
Eigen::MatrixXd denseCovariance(const Graph& graph, std::map<VariableId, int>& offsets) {
  int size = 0;
  for (const auto& [id, record] : graph.variables()) {
    if (record.fixed) continue;
    offsets[id] = size;
    size += record.kind->tangentSize();
  }
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (const auto& [id, record] : graph.factors()) {
    Evaluation at{*record.factor, {}, {}};
    for (const VariableId variable : record.variables) {
      at.kinds.push_back(graph.variable(variable).kind);
      at.values.push_back(graph.value(variable));
    }
    const double s = (record.noise.matrix() * at.residual()).squaredNorm();
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(record.factor->residualSize(), size);
    for (std::size_t i = 0; i < record.variables.size(); ++i) {
      const auto place = offsets.find(record.variables[i]);
      if (place == offsets.end()) continue;
      jacobian.middleCols(place->second, at.kinds[i]->tangentSize()) = record.noise.matrix() * at.differences(i);
    }
    information += record.weight * record.loss.evaluate(s).first_derivative * jacobian.transpose() * jacobian;
  }
  return information.inverse();
}

/// A small world in space with everything in it: a prior, points, losses, weights.
World3 richWorld() {
  World3 world = smallWorld(1);
  Noise noise(2);
  for (int i = 0; i < 4; ++i) {
    const VariableId point = world.graph.addVariable(point3(), noise.vector(10));
    for (int k = 0; k < 3; ++k)
      world.graph.addFactor({{world.ids[5 * i + 2 * k], point},
                             std::make_shared<PointFactor3>(noise.vector(3)),
                             SquareRootInformation::fromSigmas(Eigen::Vector3d(2, 2, 2)),
                             k == 0 ? Loss::cauchy(1) : Loss::none(),
                             k == 1 ? 0.5 : 1.0});
  }
  world.graph.setFixed(world.ids[0], false);
  world.graph.addFactor({{world.ids[3]},
                         std::make_shared<PriorSe3>(world.truth[3]),
                         SquareRootInformation::fromSigmas(geometry::Vector6d::Constant(0.3))});
  return world;
}

TEST(Marginals, APriorAloneGivesItsOwnCovariance) {
  Graph graph;
  const Se2 map_from_a{1, 2, 0.7};
  const VariableId a = graph.addVariable(se2(), toValue(map_from_a));
  const Eigen::Matrix3d covariance = (Eigen::Matrix3d() << 4, 1, 0.1, 1, 3, 0.2, 0.1, 0.2, 0.5).finished();
  graph.addFactor({{a}, std::make_shared<PriorSe2>(map_from_a), SquareRootInformation::fromCovariance(covariance)});
  EXPECT_LT((Marginals(graph).covariance(a) - covariance).norm(), 1e-14);
}

TEST(Marginals, AChainGivesWhatCompositionGives) {
  Graph graph;
  const Se3 a_from_b{geometry::expSo3({0.3, -0.2, 0.8}), {1, 2, 3}}, b_from_c{geometry::expSo3({1, 0.4, 0}), {2, 0, 1}};
  const geometry::Matrix6d cov_ab = (geometry::Vector6d() << 0.1, 0.2, 0.3, 0.01, 0.02, 0.03).finished().asDiagonal();
  const geometry::Matrix6d cov_bc = 2 * cov_ab;
  const VariableId a = graph.addVariable(se3(), toValue(Se3{}), true);
  const VariableId b = graph.addVariable(se3(), toValue(a_from_b));
  const VariableId c = graph.addVariable(se3(), toValue(a_from_b * b_from_c));
  graph.addFactor({{a, b}, std::make_shared<BetweenSe3>(a_from_b), SquareRootInformation::fromCovariance(cov_ab)});
  graph.addFactor({{b, c}, std::make_shared<BetweenSe3>(b_from_c), SquareRootInformation::fromCovariance(cov_bc)});
  const Marginals marginals(graph);
  EXPECT_LT((marginals.covariance(b) - cov_ab).norm(), 1e-13);
  EXPECT_LT((marginals.covariance(c) - geometry::composeCovariance(cov_ab, b_from_c, cov_bc)).norm(), 1e-12);
  const geometry::Matrix6d between =
      geometry::betweenCovariance(b_from_c, Eigen::Matrix<double, 12, 12>(marginals.jointCovariance({b, c})));
  EXPECT_LT((between - cov_bc).norm(), 1e-12);
  EXPECT_EQ(marginals.covariance(a), (Eigen::MatrixXd::Zero(6, 6)));
}

TEST(Marginals, EqualBlocksOfTheDenseInverse) {
  const World3 world = richWorld();
  std::map<VariableId, int> offsets;
  const Eigen::MatrixXd dense = denseCovariance(world.graph, offsets);
  const Marginals marginals(world.graph);
  std::vector<VariableId> ids;
  for (const auto& [id, offset] : offsets) ids.push_back(id);
  const Eigen::MatrixXd joint = marginals.jointCovariance(ids);
  EXPECT_LT((joint - dense).cwiseAbs().maxCoeff(), 1e-6 * dense.cwiseAbs().maxCoeff());
  const std::vector<VariableId> picked = {ids[20], ids[3], ids[26]};
  const Eigen::MatrixXd some = marginals.jointCovariance(picked);
  const std::vector<Eigen::MatrixXd> cross = marginals.crossCovariances(picked[1], picked);
  int row = 0;
  for (std::size_t i = 0; i < picked.size(); ++i) {
    const int size = world.graph.variable(picked[i]).kind->tangentSize();
    EXPECT_LT((some.block(row, 6, size, 6) - dense.block(offsets[picked[i]], offsets[picked[1]], size, 6)).norm(),
              1e-6);
    EXPECT_LT((some.block(row, 6, size, 6) - cross[i]).norm(), 1e-12);
    EXPECT_LT((some.block(row, row, size, size) - marginals.covariance(picked[i])).norm(), 1e-12);
    row += size;
  }
}

TEST(Marginals, AgreeWithCeresOnAGraphOfMediumSize) {
  World2 world = gridWorld(400, 3, {0.1, 0.1, 0.05});
  solve(world.graph);
  std::map<VariableId, Eigen::Vector3d> values;
  for (const VariableId id : world.ids) values[id] = world.graph.value(id);
  ceres::Problem problem;
  for (const auto& [id, record] : world.graph.factors())
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<GridEdge, 3, 3, 3>(new GridEdge{
            dynamic_cast<const BetweenSe2&>(*record.factor).measured(), Eigen::Matrix3d(record.noise.matrix())}),
        nullptr, values[record.variables[0]].data(), values[record.variables[1]].data());
  problem.SetParameterBlockConstant(values[world.ids[0]].data());
  ceres::Covariance covariance{ceres::Covariance::Options()};
  std::vector<std::pair<const double*, const double*>> blocks;
  for (const int i : {50, 200, 399}) blocks.emplace_back(values[world.ids[i]].data(), values[world.ids[399]].data());
  ASSERT_TRUE(covariance.Compute(blocks, &problem));
  const Marginals marginals(world.graph);
  for (const int i : {50, 200, 399}) {
    RowMatrix theirs(3, 3);
    covariance.GetCovarianceBlock(values[world.ids[i]].data(), values[world.ids[399]].data(), theirs.data());
    // Ceres' x and y are the map's: turned into the base by the yaw of each pose.
    Eigen::Matrix3d row_turn = Eigen::Matrix3d::Identity(), column_turn = row_turn;
    row_turn.topLeftCorner<2, 2>() = poseOf<Se2>(world.graph, world.ids[i]).rotation();
    column_turn.topLeftCorner<2, 2>() = poseOf<Se2>(world.graph, world.ids[399]).rotation();
    const Eigen::Matrix3d expected = row_turn.transpose() * theirs * column_turn;
    const Eigen::MatrixXd ours = marginals.crossCovariances(world.ids[399], {world.ids[i]})[0];
    EXPECT_LT((ours - expected).norm(), 1e-8 * expected.norm()) << i;
  }
}

TEST(Marginals, SamplesOfTheProblemScatterAsTheySay) {
  const World2 truth = gridWorld(30, 4, {0.02, 0.02, 0.01});
  const VariableId last = truth.ids.back();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  const int runs = 300;
  for (int run = 0; run < runs; ++run) {
    Graph graph;
    Noise noise(1000 + run);
    for (std::size_t i = 0; i < truth.ids.size(); ++i) graph.addVariable(se2(), toValue(truth.truth[i]), i == 0);
    for (const auto& [id, record] : truth.graph.factors()) {
      const Se2 exact = inverse(truth.truth[record.variables[0].index]) * truth.truth[record.variables[1].index];
      graph.addFactor({record.variables,
                       std::make_shared<BetweenSe2>(plus(exact, noise.normals(Eigen::Vector3d(0.02, 0.02, 0.01)))),
                       record.noise});
    }
    solve(graph);
    const Eigen::Vector3d error = minus(poseOf<Se2>(graph, last), truth.truth.back());
    scatter += error * error.transpose() / runs;
  }
  const Eigen::Matrix3d expected = Marginals(truth.graph).covariance(last);
  EXPECT_LT((scatter - expected).norm(), 0.2 * expected.norm());
}

TEST(Marginals, RefuseWhatHasNone) {
  World2 world = gridWorld(10, 5, {0.1, 0.1, 0.05});
  const VariableId alone = world.graph.addVariable(point2(), Eigen::Vector2d(0, 0));
  const Marginals marginals(world.graph);
  EXPECT_THROW(marginals.covariance(alone), base::Error);
  EXPECT_THROW(marginals.covariance({0, 999}), base::Error);
  world.graph.setFixed(world.ids[0], false);
  EXPECT_THROW(Marginals{world.graph}, base::Error);
}

}  // namespace
}  // namespace omnimapper::graph::marginals_test

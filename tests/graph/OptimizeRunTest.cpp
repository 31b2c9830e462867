#include <gtest/gtest.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "Worlds.h"
#include "omnimapper/graph/OptimizeRun.h"

namespace omnimapper::graph::optimize_run_test {
namespace {

class OptimizeRunTest : public ::testing::Test {
 protected:
  OptimizeRunTest() {
    request_.input = scratch_ / "town.g2o";
    request_.output = scratch_ / "out";
    World2 world = gridWorld(150, 3, {0.02, 0.02, 0.01});
    Noise noise(5);
    for (std::size_t i = 1; i < world.ids.size(); ++i)
      world.graph.setValue(world.ids[i], toValue(plus(world.truth[i], noise.normals(Eigen::Vector3d(0.1, 0.1, 0.05)))));
    writeG2o(world.graph, request_.input);
    Graph solved = readG2o(request_.input).graph;
    solve(solved);
    minimum_ = g2oChi2(solved);
  }
  std::string read(const std::string& name) const {
    std::ifstream file(request_.output + "/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  static int linesOf(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

  testing::ScratchFolder scratch_;
  OptimizeRequest request_;
  double minimum_ = 0;
};

TEST_F(OptimizeRunTest, BothMethodsEndAtTheMinimum) {
  for (const auto method : {OptimizeRequest::Method::batch, OptimizeRequest::Method::incremental}) {
    request_.method = method;
    const OptimizeResult result = runOptimize(request_);
    EXPECT_TRUE(result.converged) << result.text;
    const G2oContent written = readG2o(request_.output + "/optimized.g2o");
    EXPECT_NEAR(g2oChi2(written.graph), minimum_, 1e-4 * minimum_);
    EXPECT_EQ(linesOf(read("poses.csv")), 151);
  }
  EXPECT_EQ(linesOf(read("steps.csv")), 150) << "a title, and a step for each pose but the first, which is fixed";
}

TEST_F(OptimizeRunTest, ABadStartIsLeftForOneThatIsBetter) {
  const Graph good = readG2o(request_.input).graph;
  Graph spoiled = good;
  Noise noise(8);
  for (const auto& [id, record] : good.variables())
    if (!record.fixed) spoiled.setValue(id, record.value + noise.normals(Eigen::Vector3d(4, 4, 2)));
  writeG2o(spoiled, request_.input);
  const OptimizeResult best = runOptimize(request_);
  EXPECT_TRUE(best.converged);
  EXPECT_NE(best.text.find("rotations were solved for first"), std::string::npos) << best.text;
  EXPECT_NEAR(g2oChi2(readG2o(request_.output + "/optimized.g2o").graph), minimum_, 1e-6 * minimum_);
}

TEST_F(OptimizeRunTest, SigmasAreThoseOfTheMarginals) {
  request_.has_sigmas = true;
  runOptimize(request_);
  const G2oContent content = readG2o(request_.output + "/optimized.g2o");
  const base::VariableId last_id = content.ids.rbegin()->second;
  const double expected = std::sqrt(Marginals(content.graph).covariance(last_id)(0, 0));
  const std::string poses = read("poses.csv"), last = poses.substr(poses.rfind('\n', poses.size() - 2) + 1);
  EXPECT_NEAR(std::stod(last.substr(last.rfind(',') + 1)), expected, 1e-6 * expected) << last;
}

TEST_F(OptimizeRunTest, ALossLimitsFalseClosures) {
  const auto solved = [&](const Loss& loss) {
    request_.closure_loss = loss;
    runOptimize(request_);
    return readG2o(request_.output + "/optimized.g2o");
  };
  const G2oContent without = solved(Loss::none());
  G2oContent content = readG2o(request_.input);
  content.graph.addFactor({{content.ids.at(5), content.ids.at(120)},
                           std::make_shared<BetweenSe2>(geometry::Se2{9, 9, 2}),
                           SquareRootInformation::fromSigmas(Eigen::Vector3d(0.02, 0.02, 0.01))});
  writeG2o(content.graph, request_.input);
  const auto bent = [&](const Loss& loss) {
    const G2oContent with = solved(loss);
    double most = 0;
    for (const auto& [number, id] : with.ids)
      most = std::max(most, (with.graph.value(id) - without.graph.value(without.ids.at(number))).head<2>().norm());
    return most;
  };
  const double unlimited = bent(Loss::none());
  EXPECT_GT(unlimited, 1);
  // The loss also weighs true closures less, so that the rest moves, too.
  EXPECT_LT(bent(Loss::cauchy(1)), 0.25 * unlimited);
}

TEST_F(OptimizeRunTest, WhatCannotBeSolvedIsRefused) {
  std::ofstream(request_.input) << "VERTEX_SE2 0 0 0 0\n";
  EXPECT_THROW(runOptimize(request_), base::Error) << "a graph without edges";
  std::ofstream(request_.input) << "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 -1 0 0 -1 0 -1\n";
  try {
    runOptimize(request_);
    FAIL() << "an information matrix without a positive eigenvalue was taken";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("town.g2o:2"), std::string::npos) << error.what();
  }
}

TEST_F(OptimizeRunTest, ARepairedInformationIsCounted) {
  std::ofstream(request_.input) << "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 1 2 0 1 0 1\n";
  const std::string text = runOptimize(request_).text;
  EXPECT_NE(text.find("not positive definite: 1, the first on line 2"), std::string::npos) << text;
}

TEST_F(OptimizeRunTest, NumbersNeedNotFollowTheEdges) {
  // 0 - 3 - 1 - 2, where the edge to 1 comes from 3, and that to 3 is written backwards.
  std::ofstream(request_.input) << "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 0 0 0\nVERTEX_SE2 3 0 0 0\n"
                                   "EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nEDGE_SE2 3 1 1 0 0 1 0 0 1 0 1\n"
                                   "EDGE_SE2 3 0 -1 0 0 1 0 0 1 0 1\n";
  request_.method = OptimizeRequest::Method::incremental;
  EXPECT_TRUE(runOptimize(request_).converged);
  const G2oContent written = readG2o(request_.output + "/optimized.g2o");
  EXPECT_NEAR(written.graph.value(written.ids.at(3)).x(), 1, 1e-9);
  EXPECT_NEAR(written.graph.value(written.ids.at(1)).x(), 2, 1e-9);
  EXPECT_NEAR(written.graph.value(written.ids.at(2)).x(), 3, 1e-9);
}

TEST_F(OptimizeRunTest, APartThatNothingHoldsIsNamedByItsVertex) {
  std::ofstream(request_.input) << "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 40 41 1 0 0 1 0 0 1 0 1\n";
  for (const auto method : {OptimizeRequest::Method::batch, OptimizeRequest::Method::incremental}) {
    request_.method = method;
    try {
      runOptimize(request_);
      FAIL() << "a part that nothing holds was solved";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find("vertex 40"), std::string::npos) << error.what();
    }
  }
}

TEST_F(OptimizeRunTest, AnInterruptEndsIt) {
  request_.method = OptimizeRequest::Method::incremental;
  request_.progress = [](double) { return false; };
  EXPECT_THROW(runOptimize(request_), base::Error);
}

}  // namespace
}  // namespace omnimapper::graph::optimize_run_test

#include <gtest/gtest.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/Initialization.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/testing/Fixtures.h>

namespace omnimapper::graph::pose_graphs_test {
namespace {

/// A public benchmark graph and the chi-square of its optimum in g2o's convention. InitializationTest.cpp has the same
/// tests with simulated graphs.
struct PoseGraph {
  const char* file;
  double optimum;
};

void PrintTo(const PoseGraph& graph, std::ostream* out) {
  *out << graph.file;
}

class PoseGraphsTest : public ::testing::TestWithParam<PoseGraph> {
 protected:
  static void expectOptimum(Graph& graph) {
    const SolveSummary summary = solve(graph);
    EXPECT_TRUE(summary.converged) << summary.reason;
    const double optimum = GetParam().optimum;
    EXPECT_NEAR(g2oChi2(graph), optimum, 1e-4 * optimum);
  }
};

TEST_P(PoseGraphsTest, ReachesTheOptimumFromTheFilesStart) {
  const auto path = testing::sharedData(std::string("posegraphs/") + GetParam().file);
  OMNIMAPPER_NEEDS(path);
  Graph graph = readG2o(*path).graph;
  expectOptimum(graph);
}

TEST_P(PoseGraphsTest, ReachesTheOptimumFromChainedOdometry) {
  const auto path = testing::sharedData(std::string("posegraphs/") + GetParam().file);
  OMNIMAPPER_NEEDS(path);
  Graph graph = readG2o(*path).graph;
  initializeByChaining(graph);
  expectOptimum(graph);
}

TEST_P(PoseGraphsTest, ReachesTheOptimumFromRotationsFirst) {
  const auto path = testing::sharedData(std::string("posegraphs/") + GetParam().file);
  OMNIMAPPER_NEEDS(path);
  Graph graph = readG2o(*path).graph;
  initializeRotationsFirst(graph);
  expectOptimum(graph);
}

INSTANTIATE_TEST_SUITE_P(Public, PoseGraphsTest,
                         ::testing::Values(PoseGraph{"intel.g2o", 45.0047}, PoseGraph{"manhattan.g2o", 3549.04},
                                           PoseGraph{"city10000.g2o", 511.985}, PoseGraph{"sphere2500.g2o", 727.150},
                                           PoseGraph{"parking-garage.g2o", 1.23869}));

}  // namespace
}  // namespace omnimapper::graph::pose_graphs_test

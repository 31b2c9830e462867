#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/testing/Fixtures.h>

#include <sstream>

#include "Worlds.h"
#include "omnimapper/graph/G2o.h"

namespace omnimapper::graph::g2o_test {
namespace {

G2oContent read(const std::string& text) {
  std::istringstream in(text);
  return readG2o(in, "test.g2o");
}

std::string messageOf(const std::string& text) {
  try {
    read(text);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::damaged_input);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown for\n" << text;
  return {};
}

const char kPlanar[] =
    "# a comment\n"
    "VERTEX_SE2 10 0 0 0\n"
    "VERTEX_SE2 3 1 2 1.5\n"
    "\n"
    "VERTEX_XY 7 4 5\n"
    "EDGE_SE2 3 10 1 0 0.5 4 0 0 9 0 16\r\n"
    "EDGE_SE2_XY 10 7 4 4.5 1 0 4\n";

TEST(G2o, ReadsAPlanarGraph) {
  const G2oContent content = read(kPlanar);
  ASSERT_EQ(content.graph.variables().size(), 3u);
  EXPECT_EQ(content.graph.value(content.ids.at(3)), Eigen::Vector3d(1, 2, 1.5));
  EXPECT_EQ(content.graph.value(content.ids.at(7)), Eigen::Vector2d(4, 5));
  // Vertices are in the order of their numbers, and the first of them that is a pose is fixed.
  EXPECT_LT(content.ids.at(3), content.ids.at(7));
  EXPECT_LT(content.ids.at(7), content.ids.at(10));
  EXPECT_TRUE(content.graph.variable(content.ids.at(3)).fixed);
  EXPECT_FALSE(content.graph.variable(content.ids.at(10)).fixed);
  const FactorRecord& edge = content.graph.factor({0, 0});
  EXPECT_LT((edge.noise.information() - Eigen::Matrix3d(Eigen::Vector3d(4, 9, 16).asDiagonal())).norm(), 1e-14);
  EXPECT_NEAR(content.graph.whitenedResidual({0, 1}).squaredNorm(), 4 * 0.25, 1e-14);
}

TEST(G2o, ReadsASpatialGraphInG2osScaling) {
  const G2oContent content = read(
      "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"
      "VERTEX_SE3:QUAT 1 1 0 0 0 0 0.1 0.99498743710662\n"
      "EDGE_SE3:QUAT 0 1 0 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 400 0 0 400 0 400\n");
  // The translation counts 1, the quaternion's z of 0.1 counts 400 * 0.01.
  EXPECT_NEAR(g2oChi2(content.graph), 1 + 4, 1e-12);
  // In our tangent it is the angle that counts, a little more than twice the quaternion's part.
  const double angle = 2 * std::asin(0.1);
  EXPECT_NEAR(content.graph.chi2(), 1 + 100 * angle * angle, 1e-12);
}

TEST(G2o, ReadsFixAndPriors) {
  const G2oContent fixed = read(std::string(kPlanar) + "FIX 10 7\n");
  EXPECT_FALSE(fixed.graph.variable(fixed.ids.at(3)).fixed);
  EXPECT_TRUE(fixed.graph.variable(fixed.ids.at(7)).fixed);
  EXPECT_TRUE(fixed.graph.variable(fixed.ids.at(10)).fixed);
  const G2oContent prior = read(std::string(kPlanar) + "EDGE_PRIOR_SE2 3 1 2 1.4 1 0 0 1 0 1\n");
  for (const auto& [number, id] : prior.ids) EXPECT_FALSE(prior.graph.variable(id).fixed) << number;
  EXPECT_NEAR(prior.graph.whitenedResidual({0, 2})[2], 0.1, 1e-15);
}

TEST(G2o, APointSeenFromAnOffsetSensorIsTurnedIntoTheBase) {
  const G2oContent content = read(
      "PARAMS_SE3OFFSET 4 1 0 0 0 0 0.70710678118654757 0.70710678118654757\n"
      "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"
      "VERTEX_TRACKXYZ 1 1 2 0\n"
      "EDGE_SE3_TRACKXYZ 0 1 4 2 0.5 0 4 0 0 1 0 1\n");
  // The sensor at x = 1 looks along +y: 2 ahead and 0.5 to the left of it is (0.5, 2, 0) in the base.
  EXPECT_LT((content.graph.whitenedResidual({0, 0}).squaredNorm() - 0.25), 1e-14);
  const Eigen::Matrix3d information = content.graph.factor({0, 0}).noise.information();
  EXPECT_LT((information - Eigen::Matrix3d(Eigen::Vector3d(1, 4, 1).asDiagonal())).norm(), 1e-14);
}

TEST(G2o, MakesTheVerticesThatOnlyEdgesName) {
  const G2oContent content = read(
      "EDGE_SE2 0 1 1 0 1.5707963267948966 1 0 0 1 0 1\n"
      "EDGE_SE2 2 1 -1 0 0 1 0 0 1 0 1\n"
      "EDGE_SE2_XY 1 5 2 0 1 0 1\n");
  EXPECT_LT((content.graph.value(content.ids.at(1)) - Eigen::Vector3d(1, 0, geometry::kPi / 2)).norm(), 1e-15);
  EXPECT_LT((content.graph.value(content.ids.at(2)) - Eigen::Vector3d(1, 1, geometry::kPi / 2)).norm(), 1e-15);
  EXPECT_LT((content.graph.value(content.ids.at(5)) - Eigen::Vector2d(1, 2)).norm(), 1e-15);
  EXPECT_TRUE(content.graph.variable(content.ids.at(0)).fixed);
}

TEST(G2o, KeepsTheValuesThatStandThereWhenOthersAreMade) {
  const G2oContent content = read(
      "VERTEX_SE2 1 5 5 0\n"
      "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"
      "EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n");
  EXPECT_EQ(content.graph.value(content.ids.at(1)), Eigen::Vector3d(5, 5, 0));
  EXPECT_LT((content.graph.value(content.ids.at(0)) - Eigen::Vector3d(4, 5, 0)).norm(), 1e-15);
  EXPECT_LT((content.graph.value(content.ids.at(2)) - Eigen::Vector3d(6, 5, 0)).norm(), 1e-15);
  EXPECT_FALSE(content.graph.variable(content.ids.at(1)).fixed);
}

TEST(G2o, ErrorsNameFileAndLine) {
  EXPECT_EQ(messageOf("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 x 0\n").find("test.g2o:2: "), 0u);
  EXPECT_NE(messageOf("VERTEX_SE2 0 0 0\n").find(":1: "), std::string::npos);
  EXPECT_NE(messageOf("VERTEX_SE2 0 0 0 nan\n").find("nan"), std::string::npos);
  EXPECT_NE(messageOf("VERTEX_SE2 0 0 0 0 0\n").find("more on the line"), std::string::npos);
  EXPECT_NE(messageOf("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 0 0 0 0\n").find("twice"), std::string::npos);
  EXPECT_NE(messageOf("VERTEX_CAM 0 0 0 0\n").find("VERTEX_CAM"), std::string::npos);
  EXPECT_NE(messageOf("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n").find("quaternion"), std::string::npos);
  EXPECT_NE(messageOf("VERTEX_XY 1 0 0\nEDGE_SE2 0 1 0 0 0 1 0 0 1 0 1\n").find("point2"), std::string::npos);
  EXPECT_NE(messageOf("EDGE_SE2 0 0 0 0 0 1 0 0 1 0 1\n").find("itself"), std::string::npos);
  EXPECT_NE(messageOf("EDGE_SE2 0 1 0 0 0 -1 0 0 -1 0 -1\n").find("positive definite"), std::string::npos);
  EXPECT_NE(messageOf("EDGE_SE2 0 1 0 0 0 0 0 0 0 0 0\n").find("positive definite"), std::string::npos);
  EXPECT_NE(messageOf("FIX 3\n").find("vertex 3"), std::string::npos);
  EXPECT_NE(messageOf("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nEDGE_SE3_TRACKXYZ 0 1 0 0 0 0 1 0 0 1 0 1\n")
                .find("PARAMS_SE3OFFSET"),
            std::string::npos);
  EXPECT_THROW(readG2o("/no/such/file.g2o"), base::Error);
}

TEST(G2o, AnIndefiniteInformationIsTheNearestPositiveOne) {
  // Eigenvalues 3 and -1 along (1, 1) and (1, -1): the nearest is 3/2 (1, 1) (1, 1)^T, and a billionth of 3 beside.
  const G2oContent content = read(
      "VERTEX_SE2 0 0 0 0\n"
      "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"
      "EDGE_SE2 0 1 1 0 0 1 2 0 1 0 1\n"
      "EDGE_SE2 0 1 1 0 0 1 1 0 1 0 1\n");
  EXPECT_EQ(content.repaired, 2u) << "the last is singular";
  EXPECT_EQ(content.first_repaired, 3);
  std::vector<Eigen::MatrixXd> informations;
  for (const auto& [id, record] : content.graph.factors()) informations.push_back(record.noise.information());
  ASSERT_EQ(informations.size(), 3u);
  EXPECT_LT((informations[0] - Eigen::Matrix3d::Identity()).norm(), 1e-12) << "what is right stays";
  Eigen::Matrix3d expected = Eigen::Matrix3d::Identity();
  expected.topLeftCorner<2, 2>().setConstant(1.5);
  EXPECT_LT((informations[1] - expected).norm(), 1e-8);
}

TEST(G2o, WrittenAndReadAgainIsTheSameGraph) {
  World3 world = smallWorld(3);
  Noise noise(4);
  Graph& graph = world.graph;
  const auto planar = graph.addVariable(se2(), toValue(noise.se2()));
  const auto flat = graph.addVariable(point2(), noise.vector(2).head<2>());
  const auto point = graph.addVariable(point3(), noise.vector(2));
  graph.addFactor({{planar}, std::make_shared<PriorSe2>(noise.se2()), SquareRootInformation::identity(3)});
  graph.addFactor({{world.ids[4]}, std::make_shared<PriorSe3>(noise.se3()), SquareRootInformation::identity(6)});
  graph.addFactor(
      {{planar, flat}, std::make_shared<PointFactor2>(Eigen::Vector2d(1, 2)), SquareRootInformation::identity(2)});
  graph.addFactor({{world.ids[1], point},
                   std::make_shared<PointFactor3>(noise.vector(1)),
                   SquareRootInformation::identity(3),
                   {},
                   2.5});
  std::stringstream text;
  writeG2o(graph, text);
  const Graph back = readG2o(text, "written").graph;
  ASSERT_EQ(back.variables().size(), graph.variables().size());
  ASSERT_EQ(back.factors().size(), graph.factors().size());
  for (const auto& [id, record] : graph.variables()) {
    EXPECT_LT((back.value(id) - record.value).norm(), 1e-15);  // quaternions are normalized again
    EXPECT_EQ(back.variable(id).fixed, record.fixed);
  }
  EXPECT_NEAR(g2oChi2(back), g2oChi2(graph), 1e-9 * g2oChi2(graph));
  EXPECT_NEAR(back.cost(), graph.cost(), 1e-9 * graph.cost());
}

TEST(G2o, CountsWhatTheFormatCannotHold) {
  Graph graph;
  const auto a = graph.addVariable(se2(), toValue(Se2{}), true), b = graph.addVariable(se2(), toValue(Se2{}));
  graph.addFactor({{a, b}, std::make_shared<BetweenSe3>(Se3{}), SquareRootInformation::identity(6)});
  graph.addFactor({{a, b}, std::make_shared<BetweenSe2>(Se2{}), SquareRootInformation::identity(3), Loss::huber(1)});
  std::stringstream text;
  writeG2o(graph, text);
  EXPECT_EQ(text.str().find("# left out: 1 of kind between_se3\n# losses left out: 1\n"), 0u) << text.str();
  EXPECT_EQ(readG2o(text, "written").graph.factors().size(), 1u);
}

TEST(G2o, WritesAFile) {
  const testing::ScratchFolder folder;
  const World2 world = gridWorld(20, 5, {0.1, 0.1, 0.05});
  writeG2o(world.graph, folder / "grid.g2o");
  EXPECT_NEAR(g2oChi2(readG2o(folder / "grid.g2o").graph), g2oChi2(world.graph), 1e-9);
}

}  // namespace
}  // namespace omnimapper::graph::g2o_test

#include <gtest/gtest.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/Linearized.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/PlaneFactors.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/plane_factors/WallVariable.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <functional>
#include <sstream>

namespace omnimapper::plane_factors::g2o_hyperplanes_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using graph::SquareRootInformation;

/// The numbers of the line of a g2o file that begins with a tag; empty if there is none.
std::vector<double> numbersOf(const std::string& text, const std::string& tag) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first != tag) continue;
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    return numbers;
  }
  return {};
}

Eigen::MatrixXd symmetric(const double* upper, int size) {
  Eigen::MatrixXd matrix(size, size);
  for (int row = 0; row < size; ++row)
    for (int column = row; column < size; ++column) matrix(row, column) = matrix(column, row) = *upper++;
  return matrix;
}

std::string written(const graph::Graph& graph) {
  std::ostringstream out;
  graph::writeG2o(graph, out);
  return out.str();
}

/// The cost that g2o minimizes for one edge, written from its sources: edge_se2_line2d.h, edge_se3_plane_calib.h,
/// plane3d.h.
using Cost = std::function<double(const VectorXd& pose, const VectorXd& hyperplane)>;

Cost lineCost(const std::vector<double>& edge) {
  const Vector2d measured(edge[2], edge[3]);
  const Eigen::MatrixXd information = symmetric(&edge[4], 2);
  return [=](const VectorXd& pose, const VectorXd& hyperplane) {
    const double length = hyperplane.head<2>().norm();
    const Vector2d line(std::atan2(hyperplane[1], hyperplane[0]), -hyperplane[hyperplane.size() - 1] / length);
    const Vector2d normal(std::cos(line[0]), std::sin(line[0]));
    const Vector2d error(geometry::wrapToPi(line[0] - pose[2] - measured[0]),
                         line[1] - normal.dot(pose.head<2>()) - measured[1]);
    return 0.5 * error.dot(information * error);
  };
}

Cost planeCost(const std::vector<double>& edge) {
  const Eigen::Vector4d measured(edge[3], edge[4], edge[5], edge[6]);
  const Eigen::MatrixXd information = symmetric(&edge[10], 3);
  return [=](const VectorXd& pose, const VectorXd& plane) {
    const geometry::Se3 base = graph::se3FromValue(pose.data());
    const Vector3d normal = base.rotation.conjugate() * Vector3d(plane.head<3>());
    const double distance = -(plane[3] + plane.head<3>().dot(base.translation));
    const Matrix3d axes =
        (Eigen::AngleAxisd(std::atan2(normal.y(), normal.x()), Vector3d::UnitZ()) *
         Eigen::AngleAxisd(-std::atan2(normal.z(), std::hypot(normal.x(), normal.y())), Vector3d::UnitY()))
            .toRotationMatrix();
    const Vector3d seen = axes.transpose() * Vector3d(measured.head<3>());
    const Vector3d error(std::atan2(seen.y(), seen.x()), std::atan2(seen.z(), std::hypot(seen.x(), seen.y())),
                         distance + measured[3]);
    return 0.5 * error.dot(information * error);
  };
}

/// The gradient of a cost by the tangent of one of a graph's variables, by central differences.
VectorXd gradient(const graph::Graph& graph, const std::vector<base::VariableId>& variables, std::size_t by,
                  const Cost& cost) {
  constexpr double kStep = 1e-6;
  const auto& kind = *graph.variable(variables[by]).kind;
  VectorXd result(kind.tangentSize());
  for (int i = 0; i < result.size(); ++i) {
    double costs[2];
    for (const int side : {0, 1}) {
      VectorXd values[2] = {graph.value(variables[0]), graph.value(variables[1])};
      VectorXd delta = VectorXd::Zero(result.size());
      delta[i] = side == 1 ? kStep : -kStep;
      kind.plus(values[by].data(), delta.data(), values[by].data());
      costs[side] = cost(values[0], graph.variable(variables[1]).kind->hyperplane(values[1].data()));
    }
    result[i] = (costs[1] - costs[0]) / (2 * kStep);
  }
  return result;
}

void expectTheSameGradient(const graph::Graph& graph, const std::vector<base::VariableId>& variables,
                           const Cost& cost) {
  const graph::Linearized ours(graph, (*graph.factors().begin()).first);
  for (const std::size_t by : {0U, 1U}) {
    const VectorXd expected = ours.jacobians[by].transpose() * ours.residual;
    ASSERT_GT(expected.norm(), 1) << "nothing is asked";
    EXPECT_LT((gradient(graph, variables, by, cost) - expected).norm(), 2e-3 * expected.norm()) << "variable " << by;
  }
}

Eigen::Vector4d planeValue(const Vector3d& normal, double distance) {
  Eigen::Vector4d value;
  value << normal.normalized(), distance;
  return value;
}

TEST(G2oHyperplanes, AWallIsALineWithTheSameGradient) {
  graph::Graph graph;
  const auto pose = graph.addVariable(graph::se2(), Vector3d(1, 2, 0.7), true);
  const auto wall = graph.addVariable(wallVariable(), Eigen::Vector4d(4, 1, 5, 6));
  const double heading = std::atan2(5, 1) - 0.7 + 0.02;
  graph.addFactor({{pose, wall},
                   std::make_shared<WallFactor>(Vector2d(std::cos(heading), std::sin(heading)), Vector2d(2.9, 0.4)),
                   SquareRootInformation::fromSigmas(Vector2d(0.01, 0.02))});
  const std::string text = written(graph);
  EXPECT_NE(text.find("# to first order: 1 of kind wall_from_se2"), std::string::npos) << text;
  const auto line = numbersOf(text, "VERTEX_LINE2D");
  ASSERT_EQ(line.size(), 5U) << text;
  EXPECT_NEAR(std::remainder(line[1] - (std::atan2(5, 1) + geometry::kPi / 2), 2 * geometry::kPi), 0, 1e-12);
  EXPECT_NEAR(line[2], std::cos(line[1]) * 4 + std::sin(line[1]) * 1, 1e-12);
  const auto edge = numbersOf(text, "EDGE_SE2_LINE2D");
  ASSERT_EQ(edge.size(), 7U) << text;
  expectTheSameGradient(graph, {pose, wall}, lineCost(edge));
}

// Poses on the floor are lifted into space for a plane.
TEST(G2oHyperplanes, AnUprightPlaneOfAPlanarMapIsALine) {
  for (const bool is_line : {false, true}) {
    graph::Graph graph;
    const auto pose = graph.addVariable(graph::se2(), Vector3d(1, 2, 0.7), true);
    const auto plane = graph.addVariable(planeVariable(), planeValue({-0.8, 0.6, 0}, 3));
    const Vector3d in_base = Eigen::AngleAxisd(-0.7, Vector3d::UnitZ()) * Vector3d(-0.8, 0.6, 0);
    const Vector3d along = in_base.cross(Vector3d::UnitZ());
    if (is_line) {
      const Vector3d turned = Eigen::AngleAxisd(0.02, Vector3d::UnitZ()) * along;
      graph.addFactor({{pose, plane},
                       std::make_shared<LineOnPlaneFactor>(turned, -3.3 * in_base + along),
                       SquareRootInformation::fromSigmas(Vector2d(0.01, 0.02))});
    } else {
      const Vector3d turned = Eigen::AngleAxisd(0.03, Vector3d::UnitZ()) * in_base;
      graph.addFactor({{pose, plane},
                       std::make_shared<PlaneFactor>(geometry::Plane3{turned, 3.2}),
                       SquareRootInformation::fromSigmas(Vector3d(0.01, 0.01, 0.02))});
    }
    const std::string text = written(graph);
    const auto edge = numbersOf(text, "EDGE_SE2_LINE2D");
    ASSERT_EQ(edge.size(), 7U) << text;
    const graph::Linearized ours(graph, (*graph.factors().begin()).first);
    const VectorXd by_pose = ours.jacobians[0].transpose() * ours.residual;
    EXPECT_LT((gradient(graph, {pose, plane}, 0, lineCost(edge)) - by_pose).norm(), 2e-3 * by_pose.norm());
  }
}

TEST(G2oHyperplanes, ATableDoesNotConstrainThePosesOfAPlanarMap) {
  graph::Graph graph;
  const auto pose = graph.addVariable(graph::se2(), Vector3d(1, 2, 0.7), true);
  const auto table = graph.addVariable(planeVariable(), planeValue({0, 0, 1}, -0.7));
  graph.addFactor({{pose, table},
                   std::make_shared<PlaneFactor>(geometry::Plane3{Vector3d::UnitZ(), -0.72}),
                   SquareRootInformation::fromSigmas(Vector3d(0.01, 0.01, 0.02))});
  const std::string text = written(graph);
  EXPECT_NE(text.find("# left out: 1 of kind plane\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# left out: 1 of kind plane_from_se3"), std::string::npos) << text;
}

TEST(G2oHyperplanes, APlaneOfASpatialMapIsAPlaneWithTheSameGradient) {
  testing::Dice dice(3);
  for (int i = 0; i < 20; ++i) {
    const auto direction = [&] { return Vector3d(dice.normal(1), dice.normal(1), dice.normal(1)).normalized(); };
    const geometry::Se3 base{Eigen::Quaterniond(Eigen::AngleAxisd(dice.uniform(-3, 3), direction())),
                             {dice.uniform(-3, 3), dice.uniform(-3, 3), dice.uniform(-1, 1)}};
    graph::Graph graph;
    const auto pose = graph.addVariable(graph::se3(), graph::toValue(base), true);
    const Vector3d normal = direction();
    const auto plane = graph.addVariable(planeVariable(), planeValue(normal, 2));
    const Vector3d in_base = base.rotation.conjugate() * normal;
    const double distance = 2 + normal.dot(base.translation);
    if (i % 2 == 0) {
      const Vector3d seen = Eigen::AngleAxisd(0.02, direction()) * in_base;
      graph.addFactor({{pose, plane},
                       std::make_shared<PlaneFactor>(geometry::Plane3{seen, distance + 0.1}),
                       SquareRootInformation::fromSigmas(Vector3d(0.01, 0.01, 0.02))});
    } else {
      const Vector3d along = in_base.unitOrthogonal();
      graph.addFactor({{pose, plane},
                       std::make_shared<LineOnPlaneFactor>(Eigen::AngleAxisd(0.02, in_base.cross(along)) * along,
                                                           -(distance + 0.05) * in_base + 0.4 * along),
                       SquareRootInformation::fromSigmas(Vector2d(0.01, 0.02))});
    }
    const std::string text = written(graph);
    ASSERT_EQ(numbersOf(text, "VERTEX_PLANE").size(), 8U) << text;
    const auto edge = numbersOf(text, "EDGE_SE3_PLANE_CALIB");
    ASSERT_EQ(edge.size(), 16U) << text;
    EXPECT_EQ(edge[2], 2) << "the sensor, which is the last vertex";
    expectTheSameGradient(graph, {pose, plane}, planeCost(edge));
  }
}

// Our reader knows no landmarks of these kinds: it counts them and reads the rest.
TEST(G2oHyperplanes, AreCountedByTheReader) {
  graph::Graph graph;
  const auto pose = graph.addVariable(graph::se3(), graph::toValue(geometry::Se3{}), true);
  const auto plane = graph.addVariable(planeVariable(), planeValue({0, 0, 1}, 2), true);
  graph.addFactor({{pose, plane},
                   std::make_shared<PlaneFactor>(geometry::Plane3{Vector3d::UnitZ(), 2.1}),
                   SquareRootInformation::fromSigmas(Vector3d(0.01, 0.01, 0.02))});
  std::istringstream text(written(graph));
  const auto content = graph::readG2o(text, "written");
  EXPECT_EQ(content.left_out, 2U);
  EXPECT_EQ(content.graph.variables().size(), 1U) << "the sensor of the planes is none of the graph's";
  EXPECT_EQ(content.graph.factors().size(), 0U);
}

}  // namespace
}  // namespace omnimapper::plane_factors::g2o_hyperplanes_test

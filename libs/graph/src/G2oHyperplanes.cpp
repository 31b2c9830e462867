#include "G2oHyperplanes.h"

#include <omnimapper/geometry/Angle.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>

#include "omnimapper/graph/Linearized.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph::g2o {

namespace {

Eigen::VectorXd hyperplaneOf(const Graph& graph, base::VariableId id) {
  return graph.variable(id).kind->hyperplane(graph.value(id).data());
}

/// A measurement of a hyperplane depends on the pose only through the hyperplane in the base: jacobian = by_error *
/// error_by_pose. The rows of `error_by_pose` are orthonormal, so its transpose is its inverse.
struct FirstOrder {
  FirstOrder(const Graph& graph, const FactorRecord& record, const Eigen::MatrixXd& error_by_pose) {
    const Linearized factor(graph, record);
    const Eigen::MatrixXd by_error = factor.jacobians[0] * error_by_pose.transpose();
    information = record.weight * by_error.transpose() * by_error;
    error = by_error.completeOrthogonalDecomposition().solve(factor.residual);
  }
  Eigen::MatrixXd information;
  Eigen::VectorXd error;  ///< predicted - measured, in g2o's coordinates
};

}  // namespace

bool hasLine(const Eigen::VectorXd& hyperplane) {
  constexpr double kMaxTilt = 0.1736;  // sine of 10 deg
  return hyperplane.size() == 3 || std::abs(hyperplane[2]) < kMaxTilt;
}

Eigen::Vector2d lineOf(const Eigen::VectorXd& hyperplane) {
  const double length = hyperplane.head<2>().norm();
  return {std::atan2(hyperplane[1], hyperplane[0]), -hyperplane[hyperplane.size() - 1] / length};
}

HyperplaneEdge lineEdge(const Graph& graph, const FactorRecord& record) {
  const Eigen::VectorXd& pose = graph.value(record.variables[0]);
  const Eigen::Vector2d line = lineOf(hyperplaneOf(graph, record.variables[1]));
  const Eigen::Vector2d normal(std::cos(line[0]), std::sin(line[0]));
  const Eigen::Vector2d in_base(line[0] - pose[2], line[1] - normal.dot(pose.head<2>()));
  Eigen::Matrix<double, 2, 3> error_by_pose = Eigen::Matrix<double, 2, 3>::Zero();
  error_by_pose(0, 2) = -1;
  error_by_pose.block<1, 2>(1, 0) << -std::cos(in_base[0]), -std::sin(in_base[0]);
  const FirstOrder first_order(graph, record, error_by_pose);
  Eigen::Vector2d measured = in_base - first_order.error;
  measured[0] = geometry::wrapToPi(measured[0]);
  return {measured, first_order.information};
}

HyperplaneEdge planeEdge(const Graph& graph, const FactorRecord& record) {
  const geometry::Se3 map_from_base = se3FromValue(graph.value(record.variables[0]).data());
  const Eigen::Vector4d plane = hyperplaneOf(graph, record.variables[1]);
  const Eigen::Vector3d normal = map_from_base.rotation.conjugate() * Eigen::Vector3d(plane.head<3>());
  const double distance = -plane[3] - plane.head<3>().dot(map_from_base.translation);
  // g2o's error is the direction of the measured normal in a frame whose x axis is the predicted normal.
  const double azimuth = std::atan2(normal.y(), normal.x());
  const double elevation = std::atan2(normal.z(), normal.head<2>().norm());
  const Eigen::Matrix3d axes =
      (Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-elevation, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  Eigen::Matrix<double, 3, 6> error_by_pose = Eigen::Matrix<double, 3, 6>::Zero();
  error_by_pose.block<1, 3>(0, 3) = axes.col(2).transpose();
  error_by_pose.block<1, 3>(1, 3) = -axes.col(1).transpose();
  error_by_pose.block<1, 3>(2, 0) = -normal.transpose();
  const FirstOrder first_order(graph, record, error_by_pose);
  const Eigen::Vector3d error = first_order.error;
  const Eigen::Vector3d seen(std::cos(error[1]) * std::cos(error[0]), std::cos(error[1]) * std::sin(error[0]),
                             std::sin(error[1]));
  Eigen::Vector4d measured;
  measured << axes * seen, -(distance - error[2]);
  return {measured, first_order.information};
}

}  // namespace omnimapper::graph::g2o

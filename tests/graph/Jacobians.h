#pragma once

#include <gtest/gtest.h>
#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/Variable.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace omnimapper::graph {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A factor and values to evaluate it at.
struct Evaluation {
  const Factor& factor;
  std::vector<std::shared_ptr<const Variable>> kinds;
  std::vector<Eigen::VectorXd> values;

  Eigen::VectorXd residual() const { return residual(values); }
  Eigen::VectorXd residual(const std::vector<Eigen::VectorXd>& at) const {
    std::vector<const double*> pointers;
    for (const Eigen::VectorXd& value : at) pointers.push_back(value.data());
    Eigen::VectorXd r(factor.residualSize());
    factor.evaluate(pointers.data(), r.data(), nullptr);
    return r;
  }
  std::vector<RowMatrix> jacobians() const {
    std::vector<const double*> pointers;
    std::vector<RowMatrix> matrices;
    for (const auto& kind : kinds)
      matrices.push_back(RowMatrix::Constant(factor.residualSize(), kind->tangentSize(), std::nan("")));
    std::vector<double*> matrix_pointers;
    for (std::size_t i = 0; i < values.size(); ++i) {
      pointers.push_back(values[i].data());
      matrix_pointers.push_back(matrices[i].data());
    }
    Eigen::VectorXd r(factor.residualSize());
    factor.evaluate(pointers.data(), r.data(), matrix_pointers.data());
    EXPECT_EQ(r, residual()) << "the residual depends on whether Jacobians are asked for";
    return matrices;
  }
  /// Central differences through Variable::plus.
  RowMatrix differences(std::size_t variable) const {
    const double h = 1e-6;
    RowMatrix matrix(factor.residualSize(), kinds[variable]->tangentSize());
    for (int column = 0; column < matrix.cols(); ++column) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(matrix.cols());
      std::vector<Eigen::VectorXd> before = values, after = values;
      step[column] = h;
      kinds[variable]->plus(values[variable].data(), step.data(), after[variable].data());
      step[column] = -h;
      kinds[variable]->plus(values[variable].data(), step.data(), before[variable].data());
      matrix.col(column) = (residual(after) - residual(before)) / (2 * h);
    }
    return matrix;
  }
};

inline void expectJacobiansMatchDifferences(const Evaluation& evaluation, double tolerance = 1e-7) {
  const std::vector<RowMatrix> jacobians = evaluation.jacobians();
  for (std::size_t i = 0; i < jacobians.size(); ++i) {
    const RowMatrix differences = evaluation.differences(i);
    EXPECT_LT((jacobians[i] - differences).cwiseAbs().maxCoeff(), tolerance * (1 + differences.cwiseAbs().maxCoeff()))
        << evaluation.factor.kind() << ", variable " << i << "\nJacobian\n"
        << jacobians[i] << "\ndifferences\n"
        << differences;
  }
}

}  // namespace omnimapper::graph

#pragma once

#include <Eigen/Core>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph {

/// What factors that do not act yet say against what the graph knows: their whitened residuals, one after another, and
/// the covariance these have together if all are true, J inflation^2 cov J^T + I, to first order.
class Innovation {
 public:
  /// `marginals` are those of the graph; every variable of the factors must have a place in them or be fixed.
  Innovation(const Graph& graph, const Marginals& marginals, std::vector<base::FactorId> factors, double inflation);

  int size() const { return static_cast<int>(factors_.size()); }
  base::FactorId factor(int i) const { return factors_[i]; }
  int degreesOfFreedom(int i) const { return rows_[i + 1] - rows_[i]; }
  /// Chi-square of one, of two together.
  double chi2(int i) const;
  double chi2(int i, int j) const;
  /// Logarithm of the determinant of one's covariance: how little the graph knows of what it measures.
  double vagueness(int i) const;
  /// Takes one as true: the others' residuals and covariances become those given it.
  void condition(int i);

 private:
  auto residual(int i) const { return residual_.segment(rows_[i], degreesOfFreedom(i)); }
  auto covariance(int i, int j) const {
    return covariance_.block(rows_[i], rows_[j], degreesOfFreedom(i), degreesOfFreedom(j));
  }

  std::vector<base::FactorId> factors_;
  std::vector<int> rows_ = {0};  // first row of each, and the number of rows
  Eigen::VectorXd residual_;
  Eigen::MatrixXd covariance_;
};

}  // namespace omnimapper::graph

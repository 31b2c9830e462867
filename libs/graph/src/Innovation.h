#pragma once

#include <Eigen/Core>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph {

/// The innovation of one or several factors: the whitened residual, and its covariance if they are true.
struct InnovationStatistics {
  Eigen::VectorXd residual;
  Eigen::MatrixXd covariance;

  double chi2() const;
  /// Logarithm of the density of the residual, in whitened units.
  double logDensity() const;
};

/// The joint innovation of factors that do not act yet, with covariance J inflation^2 cov J^T + I, to first order.
/// Acting factors may be among them, for withdraw().
class Innovation {
 public:
  /// `marginals` are those of the graph; every variable of the factors must be in them or be fixed.
  Innovation(const Graph& graph, const Marginals& marginals, std::vector<base::FactorId> factors, double inflation);

  int size() const { return static_cast<int>(factors_.size()); }
  base::FactorId factor(int i) const { return factors_[i]; }
  int degreesOfFreedom(int i) const { return rows_[i + 1] - rows_[i]; }
  InnovationStatistics of(int i) const { return of(std::vector<int>{i}); }
  /// The joint innovation of several factors.
  InnovationStatistics of(const std::vector<int>& some) const;
  /// The innovation of one factor if others are true.
  InnovationStatistics given(int i, int other) const { return given(i, std::vector<int>{other}); }
  InnovationStatistics given(int i, const std::vector<int>& others) const;
  /// Assumes that one factor is true: the innovation of the others becomes that given it.
  void condition(int i);
  /// Removes acting factors: the innovation of the others becomes that without them. Requires inflation 1.
  void withdraw(const std::vector<int>& acting);

 private:
  Eigen::MatrixXd crossCovariance(int i, const std::vector<int>& others) const;
  auto residual(int i) const { return residual_.segment(rows_[i], degreesOfFreedom(i)); }
  auto covariance(int i, int j) const {
    return covariance_.block(rows_[i], rows_[j], degreesOfFreedom(i), degreesOfFreedom(j));
  }

  std::vector<base::FactorId> factors_;
  std::vector<int> rows_ = {0};  // first row of each, and the number of rows
  std::vector<double> weights_;  // weight with which each acts, including its loss
  Eigen::VectorXd residual_;
  Eigen::MatrixXd covariance_;
};

}  // namespace omnimapper::graph

#pragma once

#include <Eigen/Core>
#include <vector>

#include "omnimapper/graph/Graph.h"
#include "omnimapper/graph/Marginals.h"

namespace omnimapper::graph {

/// What one or several factors say against what the graph knows: whitened residual, and its covariance if they are
/// true.
struct InnovationStatistics {
  Eigen::VectorXd residual;
  Eigen::MatrixXd covariance;

  double chi2() const;
  /// Logarithm of the density of the residual, in whitened units.
  double logDensity() const;
};

/// Factors that do not act yet, all of them together: their covariance is J inflation^2 cov J^T + I, to first order.
/// Factors that act may stand among them for withdraw().
class Innovation {
 public:
  /// `marginals` are those of the graph; every variable of the factors must have a place in them or be fixed.
  Innovation(const Graph& graph, const Marginals& marginals, std::vector<base::FactorId> factors, double inflation);

  int size() const { return static_cast<int>(factors_.size()); }
  base::FactorId factor(int i) const { return factors_[i]; }
  int degreesOfFreedom(int i) const { return rows_[i + 1] - rows_[i]; }
  InnovationStatistics of(int i) const { return of(std::vector<int>{i}); }
  /// Of several together.
  InnovationStatistics of(const std::vector<int>& some) const;
  /// Of one if others are true.
  InnovationStatistics given(int i, int other) const { return given(i, std::vector<int>{other}); }
  InnovationStatistics given(int i, const std::vector<int>& others) const;
  /// Takes one as true: the innovation of the others becomes that given it.
  void condition(int i);
  /// Takes away some that act in the graph: the innovation of the others becomes that without them. Needs inflation 1.
  void withdraw(const std::vector<int>& acting);

 private:
  Eigen::MatrixXd crossCovariance(int i, const std::vector<int>& others) const;
  auto residual(int i) const { return residual_.segment(rows_[i], degreesOfFreedom(i)); }
  auto covariance(int i, int j) const {
    return covariance_.block(rows_[i], rows_[j], degreesOfFreedom(i), degreesOfFreedom(j));
  }

  std::vector<base::FactorId> factors_;
  std::vector<int> rows_ = {0};  // first row of each, and the number of rows
  std::vector<double> weights_;  // with which each acts, its loss included
  Eigen::VectorXd residual_;
  Eigen::MatrixXd covariance_;
};

}  // namespace omnimapper::graph

#include "StepRule.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::graph {

namespace {

/// Keeps undetermined directions from moving; far below the information of any measurement.
constexpr double kSmallestDamping = 1e-12;

/// (information + damping diagonal) step = -gradient. The damping grows as long as the matrix is not positive definite.
class DampedSystem {
 public:
  explicit DampedSystem(const NormalEquations& equations) : cholesky_(equations.information(), equations.groups()) {}

  /// False if no damping helps (numbers that are not finite).
  bool solve(NormalEquations& equations, double& damping, Eigen::VectorXd& step) {
    for (; damping < 1e32; damping = std::max(10 * damping, 1e-12)) {
      SymmetricMatrix& matrix = equations.information();
      saved_.clear();
      for (const int at : equations.diagonal()) {
        saved_.push_back(matrix.values[at]);
        matrix.values[at] += damping * std::max(matrix.values[at], 1e-12);
      }
      const bool positive = cholesky_.factorize(matrix);
      for (std::size_t i = 0; i < saved_.size(); ++i) matrix.values[equations.diagonal()[i]] = saved_[i];
      if (!positive) continue;
      step = cholesky_.solve(-equations.gradient());
      if (step.allFinite()) return true;
    }
    return false;
  }

 private:
  SparseCholesky cholesky_;
  std::vector<double> saved_;
};

/// Levenberg-Marquardt. Source: Nielsen, "Damping parameter in Marquardt's method", 1999.
class LevenbergMarquardt : public StepRule {
 public:
  explicit LevenbergMarquardt(const NormalEquations& equations) : system_(equations) {}
  void moved() override {}
  bool propose(NormalEquations& equations, Eigen::VectorXd& step, double& predicted) override {
    if (!system_.solve(equations, damping_, step)) return false;
    const SymmetricMatrix& matrix = equations.information();
    double damped = 0;
    for (int i = 0; i < step.size(); ++i)
      damped += damping_ * matrix.values[equations.diagonal()[i]] * step[i] * step[i];
    predicted = 0.5 * (damped - equations.gradient().dot(step));
    return true;
  }
  void judge(double ratio) override {
    if (ratio > 0) {
      damping_ = std::max(kSmallestDamping, damping_ * std::max(0.1, 1 - std::pow(2 * ratio - 1, 3)));
      growth_ = 4;
    } else {
      damping_ = std::max(damping_, 1e-10) * growth_;
      growth_ *= 4;
    }
  }

 private:
  DampedSystem system_;
  double damping_ = 1e-8;
  double growth_ = 4;
};

/// y = information * x.
Eigen::VectorXd multiply(const SymmetricMatrix& matrix, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(matrix.size);
  for (int column = 0; column < matrix.size; ++column)
    for (int at = matrix.starts[column]; at < matrix.starts[column + 1]; ++at) {
      const int row = matrix.rows[at];
      if (row < column) continue;
      y[row] += matrix.values[at] * x[column];
      if (row > column) y[column] += matrix.values[at] * x[row];
    }
  return y;
}

/// Powell's dogleg in a ball scaled by the diagonal: to the steepest descent's minimum, then towards Gauss-Newton's.
class Dogleg : public StepRule {
 public:
  explicit Dogleg(const NormalEquations& equations) : system_(equations) {}
  void moved() override { known_ = false; }
  bool propose(NormalEquations& equations, Eigen::VectorXd& step, double& predicted) override {
    if (!known_ && !linearized(equations)) return false;
    const double newton_length = newton_.norm(), cauchy_length = cauchy_.norm();
    if (radius_ < 0) radius_ = newton_length;
    if (newton_length <= radius_) {
      step = newton_;
    } else if (cauchy_length >= radius_) {
      step = radius_ / cauchy_length * cauchy_;
    } else {
      const Eigen::VectorXd leg = newton_ - cauchy_;
      const double a = leg.squaredNorm(), b = cauchy_.dot(leg), c = radius_ * radius_ - cauchy_length * cauchy_length;
      step = cauchy_ + c / (b + std::sqrt(b * b + a * c)) * leg;
    }
    length_ = step.norm();
    step = step.cwiseQuotient(scale_);
    predicted = -equations.gradient().dot(step) - 0.5 * step.dot(multiply(equations.information(), step));
    return true;
  }
  void judge(double ratio) override {
    if (ratio < 0.25) radius_ = 0.5 * length_;
    if (ratio > 0.75) radius_ = std::max(radius_, 3 * length_);
    if (ratio > 0) damping_ = std::max(kSmallestDamping, 0.1 * damping_);
  }

 private:
  bool linearized(NormalEquations& equations) {
    if (!system_.solve(equations, damping_, newton_)) return false;
    const SymmetricMatrix& matrix = equations.information();
    scale_.resize(matrix.size);
    for (int i = 0; i < matrix.size; ++i)
      scale_[i] = std::sqrt(std::max(matrix.values[equations.diagonal()[i]], 1e-12));
    newton_ = newton_.cwiseProduct(scale_);
    const Eigen::VectorXd descent = -equations.gradient().cwiseQuotient(scale_);
    const Eigen::VectorXd in_tangent = descent.cwiseQuotient(scale_);
    const double curvature = in_tangent.dot(multiply(matrix, in_tangent));
    cauchy_ = curvature > 0 ? Eigen::VectorXd(descent.squaredNorm() / curvature * descent) : descent;
    return known_ = true;
  }

  DampedSystem system_;
  double damping_ = kSmallestDamping;
  double radius_ = -1;  // in units of `scale_`; not set before the first step
  double length_ = 0;
  bool known_ = false;
  Eigen::VectorXd scale_, newton_, cauchy_;
};

}  // namespace

std::unique_ptr<StepRule> makeStepRule(SolveOptions::Method method, const NormalEquations& equations) {
  if (method == SolveOptions::Method::dogleg) return std::make_unique<Dogleg>(equations);
  return std::make_unique<LevenbergMarquardt>(equations);
}

}  // namespace omnimapper::graph

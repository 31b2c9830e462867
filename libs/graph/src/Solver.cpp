#include "omnimapper/graph/Solver.h"

#include <ceres/cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <unordered_map>

#include "Anchors.h"
#include "BoundFactor.h"
#include "OneThread.h"

namespace omnimapper::graph {

namespace {

using base::VariableId;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A variable's kind for Ceres, with a plus-Jacobian of [I; 0]: what the cost function hands over as the derivative by
/// the ambient value is already that by the tangent.
class TangentManifold : public ceres::Manifold {
 public:
  explicit TangentManifold(std::shared_ptr<const Variable> kind) : kind_(std::move(kind)) {}
  int AmbientSize() const override { return kind_->ambientSize(); }
  int TangentSize() const override { return kind_->tangentSize(); }
  bool Plus(const double* x, const double* delta, double* y) const override {
    kind_->plus(x, delta, y);
    return true;
  }
  bool Minus(const double* y, const double* x, double* delta) const override {
    kind_->minus(y, x, delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<RowMatrix>(jacobian, AmbientSize(), TangentSize()).setIdentity();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<RowMatrix>(jacobian, TangentSize(), AmbientSize()).setIdentity();
    return true;
  }

 private:
  std::shared_ptr<const Variable> kind_;
};

class CeresCost : public ceres::CostFunction {
 public:
  explicit CeresCost(BoundFactor factor) : factor_(std::move(factor)) {
    set_num_residuals(factor_.residualSize());
    for (int i = 0; i < factor_.variableCount(); ++i) {
      mutable_parameter_block_sizes()->push_back(factor_.ambientSize(i));
      strides_.push_back(factor_.ambientSize(i));
    }
  }
  bool Evaluate(double const* const* values, double* residual, double** jacobians) const override {
    factor_.evaluate(values, residual, jacobians, strides_.data());
    for (int i = 0; jacobians && i < factor_.variableCount(); ++i)
      if (jacobians[i] && factor_.tangentSize(i) < strides_[i])
        Eigen::Map<RowMatrix>(jacobians[i], factor_.residualSize(), strides_[i])
            .rightCols(strides_[i] - factor_.tangentSize(i))
            .setZero();
    return true;
  }

 private:
  BoundFactor factor_;
  std::vector<int> strides_;
};

class CeresLoss : public ceres::LossFunction {
 public:
  CeresLoss(const Loss& loss, double weight) : loss_(loss), weight_(weight) {}
  void Evaluate(double s, double rho[3]) const override {
    const Loss::Value value = loss_.evaluate(s);
    rho[0] = weight_ * value.rho;
    rho[1] = weight_ * value.first_derivative;
    rho[2] = weight_ * value.second_derivative;
  }

 private:
  Loss loss_;
  double weight_;
};

class StopCallback : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::function<bool()>& stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::function<bool()>& stop_;
};

/// The graph as Ceres sees it; the values that Ceres moves are its own copies.
class CeresProblem {
 public:
  explicit CeresProblem(const Graph& graph) : problem_(problemOptions()) {
    for (const auto& [id, record] : graph.factors())
      if (record.weight > 0) addFactor(graph, record);
  }
  ceres::Problem& problem() { return problem_; }
  void store(Graph& graph) const {
    for (const auto& [id, value] : values_)
      if (!graph.variable(id).fixed) graph.setValue(id, value);
  }

 private:
  static ceres::Problem::Options problemOptions() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void addFactor(const Graph& graph, const FactorRecord& record) {
    std::vector<double*> blocks;
    for (const VariableId id : record.variables) blocks.push_back(block(graph, id));
    const bool plain = record.weight == 1 && record.loss.kind() == Loss::Kind::none;
    problem_.AddResidualBlock(new CeresCost(BoundFactor(graph, record)),
                              plain ? nullptr : new CeresLoss(record.loss, record.weight), blocks);
  }

  double* block(const Graph& graph, VariableId id) {
    const VariableRecord& record = graph.variable(id);
    const auto [place, is_new] = values_.emplace(id, record.value);
    double* const data = place->second.data();
    if (!is_new) return data;
    std::unique_ptr<TangentManifold>& manifold = manifolds_[record.kind.get()];
    if (!manifold) manifold = std::make_unique<TangentManifold>(record.kind);
    problem_.AddParameterBlock(data, record.kind->ambientSize(), manifold.get());
    if (record.fixed) problem_.SetParameterBlockConstant(data);
    return data;
  }

  std::unordered_map<const Variable*, std::unique_ptr<TangentManifold>> manifolds_;
  std::unordered_map<VariableId, Eigen::VectorXd> values_;
  ceres::Problem problem_;
};

ceres::Solver::Options ceresOptions(const SolveOptions& options) {
  ceres::Solver::Options ceres;
  ceres.trust_region_strategy_type =
      options.method == SolveOptions::Method::dogleg ? ceres::DOGLEG : ceres::LEVENBERG_MARQUARDT;
  ceres.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  ceres.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  ceres.max_num_iterations = options.max_iterations;
  ceres.function_tolerance = options.function_tolerance;
  ceres.gradient_tolerance = 1e-12;
  ceres.parameter_tolerance = 1e-12;
  ceres.num_threads = 1;
  ceres.logging_type = ceres::SILENT;
  return ceres;
}

}  // namespace

SolveSummary solve(Graph& graph, const SolveOptions& options) {
  checkAnchored(graph);
  const OneThread one_thread;
  SolveSummary summary;
  summary.initial_cost = graph.cost();
  CeresProblem problem(graph);
  ceres::Solver::Options ceres_options = ceresOptions(options);
  StopCallback callback(options.stop);
  if (options.stop) ceres_options.callbacks.push_back(&callback);
  ceres::Solver::Summary ceres_summary;
  ceres::Solve(ceres_options, &problem.problem(), &ceres_summary);
  if (ceres_summary.IsSolutionUsable()) problem.store(graph);
  summary.iterations = static_cast<int>(ceres_summary.iterations.size()) - 1;
  summary.final_cost = graph.cost();
  summary.converged = ceres_summary.termination_type == ceres::CONVERGENCE;
  summary.reason = ceres_summary.termination_type == ceres::USER_SUCCESS ? "stopped on request" : ceres_summary.message;
  return summary;
}

}  // namespace omnimapper::graph

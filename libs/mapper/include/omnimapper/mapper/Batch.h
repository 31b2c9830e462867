#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/mapper/DecisionLog.h>

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// An atomic list of edits of the graph, with the decisions behind them. The engine applies it whole or not at all.
class Batch {
 public:
  /// Adds a variable. The id is provisional (see isProvisional): usable in factors of this batch, replaced on applying.
  /// A fixed variable keeps its value.
  base::VariableId addVariable(std::shared_ptr<const graph::Variable> kind, const Eigen::VectorXd& value,
                               bool fixed = false);
  void addFactor(graph::FactorRecord record) { added_factors_.push_back(std::move(record)); }
  void removeFactor(base::FactorId id) { removed_factors_.push_back(id); }
  void setWeight(base::FactorId id, double weight) { weights_.emplace_back(id, weight); }
  void log(Decision decision) { decisions_.push_back(std::move(decision)); }

  struct NewVariable {
    std::shared_ptr<const graph::Variable> kind;
    Eigen::VectorXd value;
    bool fixed;
  };
  /// No edit and no decision.
  bool empty() const;
  const std::vector<NewVariable>& addedVariables() const { return added_variables_; }
  const std::vector<graph::FactorRecord>& addedFactors() const { return added_factors_; }
  const std::vector<base::FactorId>& removedFactors() const { return removed_factors_; }
  const std::vector<std::pair<base::FactorId, double>>& weights() const { return weights_; }
  const std::vector<Decision>& decisions() const { return decisions_; }

  /// Provisional ids carry a session that no map has.
  static constexpr std::uint16_t kProvisionalSession = 0xFFFF;
  static bool isProvisional(base::VariableId id) { return id.session == kProvisionalSession; }

 private:
  std::vector<NewVariable> added_variables_;
  std::vector<graph::FactorRecord> added_factors_;
  std::vector<base::FactorId> removed_factors_;
  std::vector<std::pair<base::FactorId, double>> weights_;
  std::vector<Decision> decisions_;
};

/// What applying a batch gave: final ids in the order they were added.
struct AppliedBatch {
  std::vector<base::VariableId> variables;
  std::vector<base::FactorId> factors;
};

/// Applies all edits of `batch` to `graph`, or throws Error(internal) naming the edit that does not fit and leaves
/// `graph` as it was.
AppliedBatch apply(const Batch& batch, graph::Graph& graph);

}  // namespace omnimapper::mapper

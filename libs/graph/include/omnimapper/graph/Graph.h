#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/IdTable.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "omnimapper/graph/FactorRecord.h"
#include "omnimapper/graph/Variable.h"

namespace omnimapper::graph {

/// A variable in a graph.
struct VariableRecord {
  std::shared_ptr<const Variable> kind;
  Eigen::VectorXd value;                ///< [ambientSize]
  bool fixed = false;                   ///< if true, no solver changes the value
  std::vector<base::FactorId> factors;  ///< the factors that bind this variable, in the order of ids
};

/// Variables and the factors between them. The time of an edit does not grow with the graph. Copies are independent and
/// cheap: they share the records that neither copy has changed since (base::IdTable). Every method that takes an id
/// throws Error(internal), naming the id, if the graph does not contain it.
class Graph {
 public:
  /// New ids carry this session number.
  explicit Graph(std::uint16_t session = 0) : session_(session) {}
  std::uint16_t session() const { return session_; }
  /// Ids that are added from now on carry this session number.
  void setSession(std::uint16_t session) { session_ = session; }

  /// Throws Error(internal) if the value does not have the size of the kind or is not finite.
  base::VariableId addVariable(std::shared_ptr<const Variable> kind, const Eigen::VectorXd& value, bool fixed = false);
  /// Throws Error(internal) if a factor still binds the variable.
  void removeVariable(base::VariableId id);
  /// Throws Error(internal) if a variable does not exist, is bound twice or is not of the kind that the factor takes,
  /// if the noise is not of the residual's size, or if the weight is negative or not finite.
  base::FactorId addFactor(FactorRecord record);
  void removeFactor(base::FactorId id);
  /// Binds a factor to other variables; the factor's id, noise, loss, weight and tags stay. Throws as addFactor() does.
  void rebind(base::FactorId id, const std::vector<base::VariableId>& variables);

  bool contains(base::VariableId id) const { return variables_.find(id) != nullptr; }
  bool contains(base::FactorId id) const { return factors_.find(id) != nullptr; }
  const VariableRecord& variable(base::VariableId id) const;
  const FactorRecord& factor(base::FactorId id) const;
  /// Iteration in the order of ids: for (const auto& [id, record] : graph.variables()).
  const base::IdTable<base::VariableId, VariableRecord>& variables() const { return variables_; }
  const base::IdTable<base::FactorId, FactorRecord>& factors() const { return factors_; }
  const std::vector<base::FactorId>& factorsOf(base::VariableId id) const { return variable(id).factors; }

  const Eigen::VectorXd& value(base::VariableId id) const { return variable(id).value; }
  /// Throws Error(internal) if the value does not have the size of the kind or is not finite.
  void setValue(base::VariableId id, const Eigen::VectorXd& value);
  void setFixed(base::VariableId id, bool fixed);
  /// Throws Error(internal) if the weight is negative or not finite.
  void setWeight(base::FactorId id, double weight);
  void setLoss(base::FactorId id, const Loss& loss);
  /// Sets the landmark in the factor's tags.
  void setLandmark(base::FactorId id, base::LandmarkId landmark);

  /// noise * residual of the factor at the current values; weight and loss are not applied.
  Eigen::VectorXd whitenedResidual(base::FactorId id) const;
  /// Sum of weight |whitened residual|^2 over all factors; losses are not applied.
  double chi2() const;
  /// Sum of 1/2 weight loss(|whitened residual|^2) over all factors: what solve() minimizes.
  double cost() const;

 private:
  friend class GraphArchiveReader;
  VariableRecord& mutableVariable(base::VariableId id);
  FactorRecord& mutableFactor(base::FactorId id);
  void checkBinding(const FactorRecord& record) const;
  void bind(base::FactorId id);
  void unbind(base::FactorId id);

  std::uint16_t session_;
  base::IdTable<base::VariableId, VariableRecord> variables_;
  base::IdTable<base::FactorId, FactorRecord> factors_;
};

}  // namespace omnimapper::graph

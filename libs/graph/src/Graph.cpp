#include "omnimapper/graph/Graph.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cmath>

#include "BoundFactor.h"

namespace omnimapper::graph {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw base::Error(base::ExitCode::internal, "graph: " + what);
}

void checkValue(const Variable& kind, const Eigen::VectorXd& value, const std::string& which) {
  const std::string name = which + " of kind " + std::string(kind.kind());
  if (value.size() != kind.ambientSize())
    fail(name + " takes " + std::to_string(kind.ambientSize()) + " numbers, got " + std::to_string(value.size()));
  if (!value.allFinite()) fail(name + ": its value must be finite");
}

void checkWeight(double weight, const std::string& which) {
  if (!(weight >= 0) || !std::isfinite(weight))
    fail(which + ": weight " + std::to_string(weight) + " must be finite and not negative");
}

/// Calls visit(record, squared norm of the whitened residual) for each factor, in order.
template <class Visit>
void forEachSquaredNorm(const Graph& graph, const Visit& visit) {
  std::vector<const double*> values;
  Eigen::VectorXd residual;
  for (const auto& [id, record] : graph.factors()) {
    values.clear();
    for (const base::VariableId variable : record.variables) values.push_back(graph.value(variable).data());
    const BoundFactor bound(graph, record);
    residual.resize(bound.residualSize());
    bound.evaluate(values.data(), residual.data(), nullptr, nullptr);
    visit(record, residual.squaredNorm());
  }
}

}  // namespace

base::VariableId Graph::addVariable(std::shared_ptr<const Variable> kind, const Eigen::VectorXd& value, bool fixed) {
  if (!kind) fail("a variable needs a kind");
  checkValue(*kind, value, "a new variable");
  return variables_.add(session_, VariableRecord{std::move(kind), value, fixed, {}});
}

void Graph::removeVariable(base::VariableId id) {
  const std::vector<base::FactorId>& factors = variable(id).factors;
  if (!factors.empty())
    fail("variable " + toString(id) + " is still bound by factor " + toString(factors.front()) + ": remove that first");
  variables_.erase(id);
}

void Graph::checkBinding(const FactorRecord& record) const {
  if (!record.factor) fail("a factor record needs a factor");
  const std::string name = "factor of kind " + std::string(record.factor->kind());
  const std::vector<std::string_view>& kinds = record.factor->variableKinds();
  if (record.variables.size() != kinds.size())
    fail(name + " takes " + std::to_string(kinds.size()) + " variables, got " +
         std::to_string(record.variables.size()));
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const base::VariableId id = record.variables[i];
    const std::string_view bound = variable(id).kind->kind();
    if (!takes(kinds[i], bound))
      fail(name + " takes a variable of kind " + std::string(kinds[i]) + " at place " + std::to_string(i) + "; " +
           toString(id) + " is of kind " + std::string(bound));
    if (std::count(record.variables.begin(), record.variables.end(), id) > 1)
      fail(name + " binds variable " + toString(id) + " twice");
  }
  if (record.noise.size() != record.factor->residualSize())
    fail(name + " has a residual of " + std::to_string(record.factor->residualSize()) + " rows, its noise has " +
         std::to_string(record.noise.size()));
  checkWeight(record.weight, name);
}

void Graph::bind(base::FactorId id) {
  for (const base::VariableId variable : factor(id).variables) {
    // Ids grow, so this inserts at the end, unless a session with a lower number adds the factor.
    std::vector<base::FactorId>& list = mutableVariable(variable).factors;
    list.insert(std::upper_bound(list.begin(), list.end(), id), id);
  }
}

void Graph::unbind(base::FactorId id) {
  for (const base::VariableId variable : factor(id).variables) {
    std::vector<base::FactorId>& list = mutableVariable(variable).factors;
    list.erase(std::lower_bound(list.begin(), list.end(), id));
  }
}

base::FactorId Graph::addFactor(FactorRecord record) {
  checkBinding(record);
  const base::FactorId id = factors_.add(session_, std::move(record));
  bind(id);
  return id;
}

void Graph::removeFactor(base::FactorId id) {
  unbind(id);
  factors_.erase(id);
}

void Graph::rebind(base::FactorId id, const std::vector<base::VariableId>& variables) {
  FactorRecord bound_anew = factor(id);
  bound_anew.variables = variables;
  checkBinding(bound_anew);
  unbind(id);
  mutableFactor(id) = std::move(bound_anew);
  bind(id);
}

const VariableRecord& Graph::variable(base::VariableId id) const {
  const VariableRecord* record = variables_.find(id);
  if (!record) fail("there is no variable " + toString(id));
  return *record;
}

const FactorRecord& Graph::factor(base::FactorId id) const {
  const FactorRecord* record = factors_.find(id);
  if (!record) fail("there is no factor " + toString(id));
  return *record;
}

VariableRecord& Graph::mutableVariable(base::VariableId id) {
  VariableRecord* record = variables_.edit(id);
  if (!record) fail("there is no variable " + toString(id));
  return *record;
}

FactorRecord& Graph::mutableFactor(base::FactorId id) {
  FactorRecord* record = factors_.edit(id);
  if (!record) fail("there is no factor " + toString(id));
  return *record;
}

void Graph::setValue(base::VariableId id, const Eigen::VectorXd& value) {
  VariableRecord& record = mutableVariable(id);
  checkValue(*record.kind, value, "variable " + toString(id));
  record.value = value;
}

void Graph::setFixed(base::VariableId id, bool fixed) {
  mutableVariable(id).fixed = fixed;
}

void Graph::setWeight(base::FactorId id, double weight) {
  checkWeight(weight, "factor " + toString(id));
  mutableFactor(id).weight = weight;
}

void Graph::setLoss(base::FactorId id, const Loss& loss) {
  mutableFactor(id).loss = loss;
}

void Graph::setLandmark(base::FactorId id, base::LandmarkId landmark) {
  mutableFactor(id).tags.landmark = landmark;
}

Eigen::VectorXd Graph::whitenedResidual(base::FactorId id) const {
  const FactorRecord& record = factor(id);
  std::vector<const double*> values;
  for (const base::VariableId variable : record.variables) values.push_back(value(variable).data());
  const BoundFactor bound(*this, record);
  Eigen::VectorXd residual(bound.residualSize());
  bound.evaluate(values.data(), residual.data(), nullptr, nullptr);
  return residual;
}

double Graph::chi2() const {
  double sum = 0;
  forEachSquaredNorm(*this, [&](const FactorRecord& record, double s) { sum += record.weight * s; });
  return sum;
}

double Graph::cost() const {
  double sum = 0;
  forEachSquaredNorm(*this, [&](const FactorRecord& record, double s) {
    if (record.weight > 0) sum += 0.5 * record.weight * record.loss.evaluate(s).rho;
  });
  return sum;
}

}  // namespace omnimapper::graph

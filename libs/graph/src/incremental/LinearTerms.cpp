#include "LinearTerms.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::graph {

namespace {

using RowMatrix = LinearTerm::RowMatrix;

/// information = weight (J r)^T (J r), where rows of (J r) are `rows` long.
template <int rows, int columns>
void square(double weight, const RowMatrix& jacobian, Eigen::MatrixXd& information) {
  const Eigen::Map<const Eigen::Matrix<double, rows, columns, Eigen::RowMajor>> j(jacobian.data());
  const Eigen::Matrix<double, rows, columns> weighted = weight * j;
  Eigen::Map<Eigen::Matrix<double, columns, columns>>(information.data()).noalias() =
      weighted.transpose().lazyProduct(j);
}

void squareAny(double weight, const RowMatrix& jacobian, Eigen::MatrixXd& information) {
  information.resize(jacobian.cols(), jacobian.cols());
  if (jacobian.rows() == 3 && jacobian.cols() == 7) return square<3, 7>(weight, jacobian, information);
  if (jacobian.rows() == 6 && jacobian.cols() == 13) return square<6, 13>(weight, jacobian, information);
  information.noalias() = weight * jacobian.transpose().lazyProduct(jacobian);
}

}  // namespace

int LinearTerms::numberOf(base::VariableId id) const {
  const auto found = number_of_.find(id);
  return found == number_of_.end() ? -1 : found->second;
}

int LinearTerms::unknownOf(const Graph& graph, base::VariableId id) {
  const auto [place, is_new] = number_of_.emplace(id, size());
  const VariableRecord& record = graph.variable(id);
  if (is_new) {
    unknowns_.emplace_back();
    unknowns_.back().id = id;
    unknowns_.back().kind = record.kind;
    unknowns_.back().linearized = record.value;
  }
  Unknown& unknown = unknowns_[place->second];
  // What nothing binds may have been freed or fixed meanwhile, and what is fixed may have been moved.
  if (is_new || (unknown.terms.empty() && (record.fixed || unknown.size == 0))) {
    unknown.size = record.fixed ? 0 : record.kind->tangentSize();
    unknown.linearized = record.value;
    unknown.delta = Eigen::VectorXd::Zero(unknown.size);
  }
  return place->second;
}

int LinearTerms::add(const Graph& graph, base::FactorId id) {
  if (has(id))
    throw base::Error(base::ExitCode::internal,
                      "incremental solver: factor " + toString(id) + " is in the tree already");
  LinearTerm term;
  term.record = std::make_unique<FactorRecord>(graph.factor(id));
  if (term.record->weight == 0) return -1;
  term.factor.emplace(graph, *term.record);
  for (const auto variable : term.record->variables) term.slots.push_back(unknownOf(graph, variable));
  int number = static_cast<int>(terms_.size());
  if (unused_terms_.empty()) {
    terms_.emplace_back();
  } else {
    number = unused_terms_.back();
    unused_terms_.pop_back();
  }
  for (const int unknown : term.slots) {
    unknowns_[unknown].terms.push_back(number);
    if (unknowns_[unknown].size > 0) term.unknowns.push_back(unknown);
  }
  terms_[number] = std::move(term);
  term_of_.emplace(id, number);
  return number;
}

std::vector<int> LinearTerms::remove(base::FactorId id) {
  const auto found = term_of_.find(id);
  if (found == term_of_.end())
    throw base::Error(base::ExitCode::internal, "incremental solver: factor " + toString(id) + " is not in the tree");
  const int number = found->second;
  term_of_.erase(found);
  LinearTerm& term = terms_[number];
  for (const int unknown : term.slots) {
    auto& bound = unknowns_[unknown].terms;
    bound.erase(std::find(bound.begin(), bound.end(), number));
  }
  std::vector<int> unknowns = std::move(term.unknowns);
  term = LinearTerm();
  unused_terms_.push_back(number);
  return unknowns;
}

const LinearTerm& LinearTerms::linearized(int number) {
  LinearTerm& term = terms_[number];
  if (term.information.size() > 0) return term;
  const int rows = term.factor->residualSize(), slots = static_cast<int>(term.slots.size());
  int columns = 1;
  for (const int unknown : term.unknowns) columns += unknowns_[unknown].size;
  RowMatrix jacobian(rows, columns);
  Eigen::VectorXd residual(rows);
  std::vector<const double*> values;
  std::vector<double*> jacobians;
  std::vector<int> strides(static_cast<std::size_t>(slots), columns);
  int column = 0;
  for (const int unknown : term.slots) {
    values.push_back(unknowns_[unknown].linearized.data());
    jacobians.push_back(unknowns_[unknown].size > 0 ? jacobian.data() + column : nullptr);
    column += unknowns_[unknown].size;
  }
  term.factor->evaluate(values.data(), residual.data(), jacobians.data(), strides.data());
  jacobian.col(columns - 1) = residual;
  term.loss = lossAt(term, jacobian);
  squareAny(term.record->weight * term.loss, jacobian, term.information);
  if (term.record->loss.kind() != Loss::Kind::none) term.rows = std::move(jacobian);
  return term;
}

double LinearTerms::lossAt(const LinearTerm& term, const RowMatrix& rows) const {
  if (term.record->loss.kind() == Loss::Kind::none) return 1;
  Eigen::VectorXd residual = rows.col(rows.cols() - 1);
  Eigen::Index column = 0;
  for (const int unknown : term.unknowns) {
    const auto& delta = unknowns_[unknown].delta;
    residual.noalias() += rows.middleCols(column, delta.size()) * delta;
    column += delta.size();
  }
  return term.record->loss.evaluate(residual.squaredNorm()).first_derivative;
}

bool LinearTerms::isWeighedWrongly(int number, double beyond) const {
  const LinearTerm& term = terms_[number];
  if (term.rows.size() == 0 || term.information.size() == 0) return false;
  // What has hardly any weight may have a little more or less of it.
  constexpr double kHardlyAny = 1e-3;
  return std::abs(lossAt(term, term.rows) - term.loss) > beyond * std::max(term.loss, kHardlyAny);
}

std::vector<int> LinearTerms::bound() const {
  std::vector<int> numbers;
  for (int i = 0; i < size(); ++i)
    if (unknowns_[i].size > 0 && !unknowns_[i].terms.empty()) numbers.push_back(i);
  return numbers;
}

void LinearTerms::relinearize(int number) {
  place(number, estimate(number));
}

void LinearTerms::place(int number, const Eigen::VectorXd& value) {
  Unknown& unknown = unknowns_[number];
  unknown.linearized = value;
  unknown.delta.setZero();
  for (const int term : unknown.terms) terms_[term].information.resize(0, 0);
}

Eigen::VectorXd LinearTerms::estimate(int number) const {
  const Unknown& unknown = unknowns_[number];
  if (unknown.size == 0) return unknown.linearized;
  Eigen::VectorXd value(unknown.linearized.size());
  unknown.kind->plus(unknown.linearized.data(), unknown.delta.data(), value.data());
  return value;
}

}  // namespace omnimapper::graph

#include "omnimapper/graph/Marginals.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "Anchors.h"
#include "NormalEquations.h"
#include "SparseCholesky.h"

namespace omnimapper::graph {

struct Marginals::State {
  struct Span {
    int offset;  // in the information matrix, -1 for a fixed one
    int size;
  };
  std::unordered_map<base::VariableId, Span> spans;     // of those that are not fixed
  std::vector<std::pair<base::VariableId, int>> fixed;  // with their sizes, in the order of ids
  int rows = 0;                                         // of the information matrix
  std::unique_ptr<SparseCholesky> cholesky;

  std::optional<Span> find(base::VariableId id) const {
    const auto found = spans.find(id);
    if (found != spans.end()) return found->second;
    const auto held = std::lower_bound(fixed.begin(), fixed.end(), id,
                                       [](const auto& one, base::VariableId wanted) { return one.first < wanted; });
    if (held == fixed.end() || held->first != id) return std::nullopt;
    return Span{-1, held->second};
  }
  Span span(base::VariableId id) const {
    if (const auto found = find(id)) return *found;
    throw base::Error(base::ExitCode::internal,
                      "marginals: variable " + toString(id) + " is bound by no factor of positive weight, or not here");
  }
  /// The half-solved columns of a variable, none for a fixed one.
  std::vector<SparseVector> halves(Span span) const {
    std::vector<SparseVector> columns;
    for (int i = 0; span.offset >= 0 && i < span.size; ++i) columns.push_back(cholesky->halfSolve(span.offset + i));
    return columns;
  }
};

namespace {

double dot(const SparseVector& a, const SparseVector& b) {
  double sum = 0;
  for (std::size_t i = 0, j = 0; i < a.rows.size() && j < b.rows.size();) {
    if (a.rows[i] == b.rows[j])
      sum += a.values[i++] * b.values[j++];
    else if (a.rows[i] < b.rows[j])
      ++i;
    else
      ++j;
  }
  return sum;
}

Eigen::MatrixXd block(const std::vector<SparseVector>& rows, const std::vector<SparseVector>& columns) {
  Eigen::MatrixXd product(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
      product(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = dot(rows[i], columns[j]);
  return product;
}

}  // namespace

Marginals::Marginals(const Graph& graph) : state_(std::make_unique<State>()) {
  checkAnchored(graph);
  NormalEquations equations(graph);
  equations.linearise(equations.values(graph));
  for (const auto& [id, record] : graph.variables()) {
    const int size = record.kind->tangentSize();
    if (record.fixed) {
      state_->fixed.emplace_back(id, size);
    } else if (equations.contains(id)) {
      state_->spans[id] = {equations.offset(id), size};
    }
  }
  state_->rows = equations.information().size;
  if (state_->rows == 0) return;
  state_->cholesky = std::make_unique<SparseCholesky>(equations.information(), equations.groups());
  if (!state_->cholesky->factorize(equations.information(), SparseCholesky::Storage::columns))
    throw base::Error(base::ExitCode::internal,
                      "marginals: the information matrix is singular: a direction of some variable is determined by "
                      "nothing; add a prior or another factor there");
}

Marginals::~Marginals() = default;
Marginals::Marginals(Marginals&&) noexcept = default;
Marginals& Marginals::operator=(Marginals&&) noexcept = default;

bool Marginals::contains(base::VariableId id) const {
  return state_->find(id).has_value();
}

Eigen::MatrixXd Marginals::covariance(base::VariableId id) const {
  return jointCovariance({id});
}

Eigen::MatrixXd Marginals::jointCovariance(const std::vector<base::VariableId>& ids) const {
  std::vector<std::vector<SparseVector>> halves;
  std::vector<int> offsets = {0};
  for (const base::VariableId id : ids) {
    const State::Span span = state_->span(id);
    halves.push_back(state_->halves(span));
    offsets.push_back(offsets.back() + span.size);
  }
  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(offsets.back(), offsets.back());
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      if (halves[i].empty() || halves[j].empty()) continue;
      const Eigen::MatrixXd part = block(halves[i], halves[j]);
      joint.block(offsets[i], offsets[j], part.rows(), part.cols()) = part;
      joint.block(offsets[j], offsets[i], part.cols(), part.rows()) = part.transpose();
    }
  return joint;
}

std::vector<Eigen::MatrixXd> Marginals::crossCovariances(base::VariableId id,
                                                         const std::vector<base::VariableId>& others) const {
  // Solved for the columns of `id` as a whole: cheaper than a path through the factor for each of the others.
  const State::Span span = state_->span(id);
  Eigen::MatrixXd columns;
  if (span.offset >= 0) {
    columns.setZero(state_->rows, span.size);
    for (int i = 0; i < span.size; ++i) columns(span.offset + i, i) = 1;
    columns = state_->cholesky->solve(columns);
  }
  std::vector<Eigen::MatrixXd> blocks;
  for (const base::VariableId other : others) {
    const State::Span other_span = state_->span(other);
    if (other_span.offset < 0 || span.offset < 0)
      blocks.emplace_back(Eigen::MatrixXd::Zero(other_span.size, span.size));
    else
      blocks.emplace_back(columns.middleRows(other_span.offset, other_span.size));
  }
  return blocks;
}

}  // namespace omnimapper::graph

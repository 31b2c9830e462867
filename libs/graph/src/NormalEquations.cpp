#include "NormalEquations.h"

#include <algorithm>
#include <numeric>

namespace omnimapper::graph {

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// out += weight a^T b, a [rows x a_columns], b [rows x b_columns] row-major, out by columns.
template <int rows, int a_columns, int b_columns>
void addProduct(double weight, const double* a, const double* b, double* out, int stride) {
  const Eigen::Map<const Eigen::Matrix<double, rows, a_columns, Eigen::RowMajor>> left(a);
  const Eigen::Map<const Eigen::Matrix<double, rows, b_columns, b_columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>>
      right(b);
  Eigen::Map<Eigen::Matrix<double, a_columns, b_columns>, 0, Eigen::OuterStride<>> sum(out,
                                                                                       Eigen::OuterStride<>(stride));
  const Eigen::Matrix<double, rows, b_columns> weighted = weight * right;
  sum += left.transpose().lazyProduct(weighted);
}

void addProduct(int rows, int a_columns, int b_columns, double weight, const double* a, const double* b, double* out,
                int stride) {
  if (rows == 3 && a_columns == 3 && b_columns == 3) return addProduct<3, 3, 3>(weight, a, b, out, stride);
  if (rows == 6 && a_columns == 6 && b_columns == 6) return addProduct<6, 6, 6>(weight, a, b, out, stride);
  const Eigen::Map<const RowMatrix> left(a, rows, a_columns), right(b, rows, b_columns);
  Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> sum(out, a_columns, b_columns, Eigen::OuterStride<>(stride));
  sum += weight * left.transpose().lazyProduct(right);
}

}  // namespace

NormalEquations::NormalEquations(const Graph& graph) {
  addPlaces(graph);
  addTerms(graph);
  const std::vector<ColumnPattern> patterns = columnPatterns();
  buildMatrix(patterns);
  bindBlocks(patterns);
}

void NormalEquations::addPlaces(const Graph& graph) {
  // The variables are collected from the factors, because many variables may no longer be bound by any.
  std::vector<base::VariableId> bound;
  for (const auto& [id, record] : graph.factors()) {
    if (record.weight > 0) bound.insert(bound.end(), record.variables.begin(), record.variables.end());
  }
  std::sort(bound.begin(), bound.end());
  bound.erase(std::unique(bound.begin(), bound.end()), bound.end());
  int rows = 0;
  for (const base::VariableId id : bound) {
    const VariableRecord& record = graph.variable(id);
    Place place{id, record.kind.get(), value_size_, -1, -1};
    value_size_ += place.kind->ambientSize();
    if (!record.fixed) {
      place.tangent_offset = rows;
      place.group = static_cast<int>(groups_.size());
      groups_.push_back(place.kind->tangentSize());
      group_offsets_.push_back(rows);
      rows += groups_.back();
    }
    place_of_.emplace(id, static_cast<int>(places_.size()));
    places_.push_back(place);
  }
  information_.size = rows;
  gradient_.resize(rows);
}

void NormalEquations::addTerms(const Graph& graph) {
  for (const auto& [id, record] : graph.factors()) {
    if (record.weight == 0) continue;
    Term term{BoundFactor(graph, record), {}, {}};
    for (const base::VariableId variable : record.variables) term.places.push_back(place_of_.at(variable));
    terms_.push_back(std::move(term));
  }
}

std::vector<NormalEquations::ColumnPattern> NormalEquations::columnPatterns() const {
  std::vector<ColumnPattern> patterns(groups_.size());
  for (std::size_t group = 0; group < groups_.size(); ++group)
    patterns[group].groups.push_back(static_cast<int>(group));
  for (const Term& term : terms_)
    for (const int a : term.places)
      for (const int b : term.places)
        if (places_[a].group >= 0 && places_[b].group > places_[a].group)
          patterns[places_[a].group].groups.push_back(places_[b].group);
  for (ColumnPattern& pattern : patterns) {
    std::sort(pattern.groups.begin(), pattern.groups.end());
    pattern.groups.erase(std::unique(pattern.groups.begin(), pattern.groups.end()), pattern.groups.end());
    int row = 0;
    for (const int group : pattern.groups) {
      pattern.first_rows.push_back(row);
      row += groups_[group];
    }
    pattern.first_rows.push_back(row);
  }
  return patterns;
}

void NormalEquations::buildMatrix(const std::vector<ColumnPattern>& patterns) {
  information_.starts.push_back(0);
  for (std::size_t group = 0; group < patterns.size(); ++group)
    for (int column = 0; column < groups_[group]; ++column) {
      diagonal_.push_back(static_cast<int>(information_.rows.size()) + column);
      for (const int row_group : patterns[group].groups)
        for (int row = 0; row < groups_[row_group]; ++row) information_.rows.push_back(group_offsets_[row_group] + row);
      information_.starts.push_back(static_cast<int>(information_.rows.size()));
    }
  information_.values.resize(information_.rows.size());
}

void NormalEquations::bindBlocks(const std::vector<ColumnPattern>& patterns) {
  for (Term& term : terms_)
    for (std::size_t i = 0; i < term.places.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        Block block;
        const int a = places_[term.places[i]].group, b = places_[term.places[j]].group;
        if (a >= 0 && b >= 0) {
          const int column = std::min(a, b);
          const ColumnPattern& pattern = patterns[column];
          const auto found = std::lower_bound(pattern.groups.begin(), pattern.groups.end(), std::max(a, b));
          block.stride = pattern.first_rows.back();
          block.first =
              information_.starts[group_offsets_[column]] + pattern.first_rows[found - pattern.groups.begin()];
          block.swapped = a < b;
        }
        term.blocks.push_back(block);
      }
}

double NormalEquations::linearize(const Eigen::VectorXd& values) {
  std::fill(information_.values.begin(), information_.values.end(), 0);
  gradient_.setZero();
  double cost = 0;
  std::vector<double> memory;
  std::vector<const double*> slot_values;
  std::vector<double*> jacobians;
  std::vector<int> strides;
  for (const Term& term : terms_) {
    const int rows = term.factor.residualSize(), slots = term.factor.variableCount();
    int columns = 0;
    for (int i = 0; i < slots; ++i) columns += term.factor.tangentSize(i);
    memory.resize(std::max(memory.size(), static_cast<std::size_t>(rows * (columns + 1))));
    slot_values.clear();
    jacobians.clear();
    strides.clear();
    double* next = memory.data() + rows;
    for (int i = 0; i < slots; ++i) {
      const Place& place = places_[term.places[i]];
      slot_values.push_back(values.data() + place.value_offset);
      strides.push_back(term.factor.tangentSize(i));
      jacobians.push_back(place.group < 0 ? nullptr : next);
      next += rows * strides.back();
    }
    term.factor.evaluate(slot_values.data(), memory.data(), jacobians.data(), strides.data());
    const FactorRecord& record = term.factor.record();
    const Loss::Value loss = record.loss.evaluate(Eigen::Map<const Eigen::VectorXd>(memory.data(), rows).squaredNorm());
    cost += 0.5 * record.weight * loss.rho;
    accumulate(term, record.weight * loss.first_derivative, memory.data(), jacobians.data());
  }
  return cost;
}

void NormalEquations::accumulate(const Term& term, double weight, const double* residual,
                                 const double* const* jacobians) {
  const int rows = term.factor.residualSize(), slots = term.factor.variableCount();
  const Block* block = term.blocks.data();
  for (int i = 0; i < slots; ++i) {
    const int size = term.factor.tangentSize(i);
    if (jacobians[i])
      Eigen::Map<Eigen::VectorXd>(gradient_.data() + places_[term.places[i]].tangent_offset, size).noalias() +=
          weight * Eigen::Map<const RowMatrix>(jacobians[i], rows, size)
                       .transpose()
                       .lazyProduct(Eigen::Map<const Eigen::VectorXd>(residual, rows));
    for (int j = 0; j <= i; ++j, ++block) {
      if (block->first < 0) continue;
      const int row_slot = block->swapped ? j : i, column_slot = block->swapped ? i : j;
      addProduct(rows, term.factor.tangentSize(row_slot), term.factor.tangentSize(column_slot), weight,
                 jacobians[row_slot], jacobians[column_slot], information_.values.data() + block->first, block->stride);
    }
  }
}

double NormalEquations::cost(const Eigen::VectorXd& values) const {
  double cost = 0;
  Eigen::VectorXd residual;
  std::vector<const double*> slot_values;
  for (const Term& term : terms_) {
    slot_values.clear();
    for (const int place : term.places) slot_values.push_back(values.data() + places_[place].value_offset);
    residual.resize(term.factor.residualSize());
    term.factor.evaluate(slot_values.data(), residual.data(), nullptr, nullptr);
    const FactorRecord& record = term.factor.record();
    cost += 0.5 * record.weight * record.loss.evaluate(residual.squaredNorm()).rho;
  }
  return cost;
}

void NormalEquations::plus(const Eigen::VectorXd& values, const Eigen::VectorXd& step, Eigen::VectorXd& moved) const {
  moved = values;
  for (const Place& place : places_)
    if (place.group >= 0)
      place.kind->plus(values.data() + place.value_offset, step.data() + place.tangent_offset,
                       moved.data() + place.value_offset);
}

Eigen::VectorXd NormalEquations::values(const Graph& graph) const {
  Eigen::VectorXd values(value_size_);
  for (const Place& place : places_)
    values.segment(place.value_offset, place.kind->ambientSize()) = graph.value(place.id);
  return values;
}

void NormalEquations::store(const Eigen::VectorXd& values, Graph& graph) const {
  for (const Place& place : places_)
    if (place.group >= 0) graph.setValue(place.id, values.segment(place.value_offset, place.kind->ambientSize()));
}

int NormalEquations::offset(base::VariableId id) const {
  const auto found = place_of_.find(id);
  return found == place_of_.end() ? -1 : places_[found->second].tangent_offset;
}

}  // namespace omnimapper::graph

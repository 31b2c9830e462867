#include "omnimapper/graph/Marginals.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>

#include "GaugeCheck.h"
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
    throw base::Error(
        base::ExitCode::internal,
        "marginals: variable " + toString(id) + " is bound by no factor of positive weight, or is not in the graph");
  }
};

namespace {

// The number of entries that both vectors have. Both follow paths to the root of the elimination tree, which are the
// same from the row where they meet, so the common entries are at the end of both.
std::size_t common(const SparseVector& a, const SparseVector& b) {
  std::size_t alike = 0, different = std::min(a.rows.size(), b.rows.size()) + 1;
  while (alike + 1 < different) {
    const std::size_t tried = (alike + different) / 2;
    (a.rows[a.rows.size() - tried] == b.rows[b.rows.size() - tried] ? alike : different) = tried;
  }
  return alike;
}

double dot(const SparseVector& a, const SparseVector& b) {
  const auto shared = static_cast<Eigen::Index>(common(a, b));
  const auto tail = [&](const SparseVector& vector) {
    return Eigen::Map<const Eigen::VectorXd>(vector.values.data() + vector.values.size() - shared, shared);
  };
  return tail(a).dot(tail(b));
}

}  // namespace

/// A cache of covariance blocks and of the half-solved columns from which they are computed, because the same blocks
/// are requested again at the next key frame.
class Marginals::Blocks {
 public:
  /// The block of two variables, of which `later` does not come before `earlier` in the matrix. Valid until
  /// forgetIfMany().
  const Eigen::MatrixXd& of(const SparseCholesky& cholesky, State::Span later, State::Span earlier) {
    Eigen::MatrixXd& block =
        blocks_[(static_cast<std::uint64_t>(later.offset) << 32) | static_cast<std::uint64_t>(earlier.offset)];
    if (block.size() > 0) return block;
    const auto &left = halves(cholesky, later), &right = halves(cholesky, earlier);
    block.resize(later.size, earlier.size);
    for (int i = 0; i < later.size; ++i)
      for (int j = 0; j < earlier.size; ++j)
        block(i, j) = dot(left[static_cast<std::size_t>(i)], right[static_cast<std::size_t>(j)]);
    kept_ += kBlock + static_cast<std::size_t>(block.size());
    return block;
  }
  /// Keeps memory within bounds.
  void forgetIfMany() {
    constexpr std::size_t kMost = 4'000'000;  // numbers
    if (kept_ < kMost) return;
    blocks_.clear();
    halves_.clear();
    kept_ = 0;
  }

  std::mutex mutex;

 private:
  static constexpr std::size_t kBlock = 12;  // memory of a block beside its numbers, in numbers

  const std::vector<SparseVector>& halves(const SparseCholesky& cholesky, State::Span span) {
    auto& columns = halves_[span.offset];
    for (int i = static_cast<int>(columns.size()); i < span.size; ++i) {
      columns.push_back(cholesky.halfSolve(span.offset + i));
      kept_ += 2 * columns.back().rows.size();
    }
    return columns;
  }

  std::unordered_map<std::uint64_t, Eigen::MatrixXd> blocks_;  // by the two offsets
  std::unordered_map<int, std::vector<SparseVector>> halves_;
  std::size_t kept_ = 0;
};

Marginals::Marginals(const Graph& graph) : state_(std::make_unique<State>()), blocks_(std::make_unique<Blocks>()) {
  checkGauge(graph);
  NormalEquations equations(graph);
  equations.linearize(equations.values(graph));
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
                      "marginals: the information matrix is singular: some direction of a variable is undetermined; "
                      "add a prior or another factor there");
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
  std::vector<State::Span> spans;
  std::vector<int> offsets = {0};
  for (const base::VariableId id : ids) {
    spans.push_back(state_->span(id));
    offsets.push_back(offsets.back() + spans.back().size);
  }
  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(offsets.back(), offsets.back());
  const std::lock_guard lock(blocks_->mutex);
  blocks_->forgetIfMany();
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      if (spans[i].offset < 0 || spans[j].offset < 0) continue;
      const bool in_order = spans[i].offset >= spans[j].offset;
      const std::size_t later = in_order ? i : j, earlier = in_order ? j : i;
      const Eigen::MatrixXd& part = blocks_->of(*state_->cholesky, spans[later], spans[earlier]);
      joint.block(offsets[later], offsets[earlier], part.rows(), part.cols()) = part;
      joint.block(offsets[earlier], offsets[later], part.cols(), part.rows()) = part.transpose();
    }
  return joint;
}

std::vector<Eigen::MatrixXd> Marginals::crossCovariances(base::VariableId id,
                                                         const std::vector<base::VariableId>& others) const {
  // The columns of `id` are solved as a whole, which is cheaper than a path through the factor for each of the others.
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

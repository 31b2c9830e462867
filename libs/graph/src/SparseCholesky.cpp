#include "SparseCholesky.h"

#include <cholmod.h>
#include <omnimapper/base/Error.h>

#include "SingleThreadedBlas.h"

namespace omnimapper::graph {

/// The data of CHOLMOD, freed with this object.
struct SparseCholesky::State {
  State() {
    cholmod_start(&common);
    common.print = 0;
  }
  ~State() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  cholmod_common common;
  cholmod_factor* factor = nullptr;
  std::vector<int> place;  // of a row of A in P A P^T
};

namespace {

/// CHOLMOD's view of a SymmetricMatrix, which it only reads.
cholmod_sparse view(const SymmetricMatrix& matrix) {
  cholmod_sparse sparse{};
  sparse.nrow = sparse.ncol = static_cast<std::size_t>(matrix.size);
  sparse.nzmax = matrix.rows.size();
  sparse.p = const_cast<int*>(matrix.starts.data());
  sparse.i = const_cast<int*>(matrix.rows.data());
  sparse.x = const_cast<double*>(matrix.values.data());
  sparse.stype = -1;
  sparse.itype = CHOLMOD_INT;
  sparse.xtype = matrix.values.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = 1;
  sparse.packed = 1;
  return sparse;
}

[[noreturn]] void failOutOfMemory() {
  throw base::Error(base::ExitCode::internal, "graph: CHOLMOD cannot factor this system: too large for the memory");
}

/// The pattern of the groups: one row and column for each.
SymmetricMatrix quotient(const SymmetricMatrix& pattern, const std::vector<int>& groups) {
  std::vector<int> group_of_row;
  for (std::size_t group = 0; group < groups.size(); ++group)
    group_of_row.insert(group_of_row.end(), static_cast<std::size_t>(groups[group]), static_cast<int>(group));
  SymmetricMatrix reduced;
  reduced.size = static_cast<int>(groups.size());
  reduced.starts.push_back(0);
  int column = 0;
  for (const int size : groups) {
    for (int at = pattern.starts[column]; at < pattern.starts[column + 1]; ++at) {
      const int row = group_of_row[pattern.rows[at]];
      if (static_cast<int>(reduced.rows.size()) == reduced.starts.back() || reduced.rows.back() != row)
        reduced.rows.push_back(row);
    }
    reduced.starts.push_back(static_cast<int>(reduced.rows.size()));
    column += size;
  }
  return reduced;
}

/// The order of rows for an order of groups: the rows of each group are next to each other.
std::vector<int> expand(const std::vector<int>& group_order, const std::vector<int>& groups) {
  std::vector<int> first_row(groups.size() + 1, 0);
  for (std::size_t i = 0; i < groups.size(); ++i) first_row[i + 1] = first_row[i] + groups[i];
  std::vector<int> order;
  for (const int group : group_order)
    for (int row = first_row[group]; row < first_row[group + 1]; ++row) order.push_back(row);
  return order;
}

}  // namespace

SparseCholesky::SparseCholesky(const SymmetricMatrix& pattern, const std::vector<int>& groups)
    : state_(std::make_unique<State>()) {
  cholmod_common& common = state_->common;
  const SingleThreadedBlas one_thread;
  cholmod_sparse matrix = view(pattern);
  matrix.xtype = CHOLMOD_PATTERN;
  if (groups.empty()) {
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    state_->factor = cholmod_analyze(&matrix, &common);
  } else {
    const SymmetricMatrix reduced = quotient(pattern, groups);
    cholmod_sparse reduced_view = view(reduced);
    reduced_view.xtype = CHOLMOD_PATTERN;
    std::vector<int> group_order(groups.size());
    if (!cholmod_amd(&reduced_view, nullptr, 0, group_order.data(), &common)) failOutOfMemory();
    std::vector<int> order = expand(group_order, groups);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    state_->factor = cholmod_analyze_p(&matrix, order.data(), nullptr, 0, &common);
  }
  if (!state_->factor) failOutOfMemory();
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factorize(const SymmetricMatrix& matrix, Storage storage) {
  const SingleThreadedBlas one_thread;
  cholmod_sparse sparse = view(matrix);
  cholmod_common& common = state_->common;
  cholmod_factor& factor = *state_->factor;
  cholmod_factorize(&sparse, &factor, &common);
  if (common.status < CHOLMOD_OK) failOutOfMemory();
  if (common.status == CHOLMOD_NOT_POSDEF || factor.minor < factor.n) return false;
  if (storage == Storage::dense_blocks) return true;
  if (!cholmod_change_factor(CHOLMOD_REAL, 1, 0, 1, 1, &factor, &common)) failOutOfMemory();
  state_->place.resize(factor.n);
  const int* order = static_cast<const int*>(factor.Perm);
  for (std::size_t i = 0; i < factor.n; ++i) state_->place[order[i]] = static_cast<int>(i);
  return true;
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& b) {
  const SingleThreadedBlas one_thread;
  cholmod_common& common = state_->common;
  cholmod_dense dense{};
  dense.nrow = dense.d = static_cast<std::size_t>(b.rows());
  dense.ncol = static_cast<std::size_t>(b.cols());
  dense.nzmax = dense.nrow * dense.ncol;
  dense.x = const_cast<double*>(b.data());
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, state_->factor, &dense, &common);
  if (!x) failOutOfMemory();
  const Eigen::MatrixXd solution = Eigen::Map<const Eigen::MatrixXd>(static_cast<double*>(x->x), b.rows(), b.cols());
  cholmod_free_dense(&x, &common);
  return solution;
}

SparseVector SparseCholesky::halfSolve(int row) const {
  // Forward substitution with a unit vector touches the elimination tree's path from its row to the root and nothing
  // else; a column's parent is the first row below its diagonal.
  const cholmod_factor& factor = *state_->factor;
  const int* starts = static_cast<const int*>(factor.p);
  const int* counts = static_cast<const int*>(factor.nz);
  const int* rows = static_cast<const int*>(factor.i);
  const double* values = static_cast<const double*>(factor.x);
  SparseVector result;
  std::vector<double> x(factor.n, 0);
  x[state_->place[row]] = 1;
  for (int column = state_->place[row]; column >= 0;) {
    const int begin = starts[column], end = begin + counts[column];
    const double solved = x[column] / values[begin];
    for (int at = begin + 1; at < end; ++at) x[rows[at]] -= values[at] * solved;
    result.rows.push_back(column);
    result.values.push_back(solved);
    column = begin + 1 < end ? rows[begin + 1] : -1;
  }
  return result;
}

}  // namespace omnimapper::graph

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace omnimapper::graph {

/// A symmetric matrix, its lower triangle stored by columns. Entries of the upper triangle may be there too and are
/// ignored.
struct SymmetricMatrix {
  int size = 0;
  std::vector<int> starts;  ///< [size + 1]: where each column starts in rows and values
  std::vector<int> rows;    ///< ascending within a column
  std::vector<double> values;
};

/// Entries of a vector that are not zero, rows ascending.
struct SparseVector {
  std::vector<int> rows;
  std::vector<double> values;
};

/// L L^T = P A P^T of a sparse positive definite matrix A, by CHOLMOD, with P to keep L sparse.
class SparseCholesky {
 public:
  /// How L is stored: dense blocks are faster to compute, but halfSolve() needs single columns.
  enum class Storage { dense_blocks, columns };

  /// Orders the matrix by its pattern. `groups`, where not empty, are the sizes of runs of rows that share one pattern
  /// (the rows of a variable): ordering the groups is faster.
  SparseCholesky(const SymmetricMatrix& pattern, const std::vector<int>& groups);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// The matrix must have the pattern of the constructor. False if it is not positive definite.
  bool factorize(const SymmetricMatrix& matrix, Storage storage = Storage::dense_blocks);
  /// A^-1 b.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b);
  /// L^-1 P e, for e the unit vector of a row: its few entries that are not zero. x(i)^T x(j) is the inverse's entry
  /// (i, j). Needs Storage::columns.
  SparseVector halfSolve(int row) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace omnimapper::graph

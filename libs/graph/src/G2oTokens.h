#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

namespace omnimapper::graph {

/// The words of one line of a .g2o file. Numbers do not depend on the locale.
/// Everything throws Error(damaged_input) with the file's name and the line's number.
class G2oTokens {
 public:
  G2oTokens(std::string_view line, const std::string& file, int number) : rest_(line), file_(file), number_(number) {}

  /// The next word; empty at the end.
  std::string_view word();
  /// True if no word is left.
  bool atEnd() { return G2oTokens(*this).word().empty(); }
  double number();
  std::int64_t id();
  template <int size>
  Eigen::Matrix<double, size, 1> numbers() {
    Eigen::Matrix<double, size, 1> values;
    for (double& value : values) value = number();
    return values;
  }
  /// The upper triangle of a symmetric matrix, row by row.
  template <int size>
  Eigen::Matrix<double, size, size> symmetric() {
    Eigen::Matrix<double, size, size> matrix;
    for (int row = 0; row < size; ++row)
      for (int column = row; column < size; ++column) matrix(row, column) = matrix(column, row) = number();
    return matrix;
  }
  int lineNumber() const { return number_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view rest_;
  const std::string& file_;
  int number_;
};

}  // namespace omnimapper::graph

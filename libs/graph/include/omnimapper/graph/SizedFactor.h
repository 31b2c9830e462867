#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <vector>

#include "omnimapper/graph/Factor.h"

namespace omnimapper::graph {

/// A factor whose number of rows and kinds of variables are known at compile time. Each of `Kinds` is a type with the
/// members `kName`, which is Variable::kind(), and `kTangentSize`.
template <int Rows, class... Kinds>
class SizedFactor : public Factor {
 public:
  int residualSize() const final { return Rows; }
  const std::vector<std::string_view>& variableKinds() const final {
    static const std::vector<std::string_view> names = {Kinds::kName...};
    return names;
  }

 protected:
  /// The derivative by variable number `Index` [Rows x tangentSize of its kind], to which evaluate() assigns. The
  /// returned object converts to false if the caller does not ask for this derivative.
  template <std::size_t Index>
  static auto jacobian(double* const* jacobians) {
    using Kind = std::tuple_element_t<Index, std::tuple<Kinds...>>;
    return Jacobian<Kind::kTangentSize>(jacobians ? jacobians[Index] : nullptr);
  }

 private:
  template <int Columns>
  using RowMajor = Eigen::Map<Eigen::Matrix<double, Rows, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>>;

  template <int Columns>
  class Jacobian : public RowMajor<Columns> {
   public:
    explicit Jacobian(double* data) : RowMajor<Columns>(data) {}
    using RowMajor<Columns>::operator=;
    explicit operator bool() const { return this->data() != nullptr; }
  };
};

}  // namespace omnimapper::graph

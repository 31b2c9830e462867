#include "BoundFactor.h"

#include <array>

#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

constexpr int kLiftedColumns[3] = {0, 1, 5};

/// Working memory of one evaluation: on the stack up to `usual_size`.
template <class Number, int usual_size>
class Scratch {
 public:
  explicit Scratch(int size) {
    if (size > usual_size) large_.resize(static_cast<std::size_t>(size));
  }
  Number* data() { return large_.empty() ? small_.data() : large_.data(); }

 private:
  std::array<Number, usual_size> small_;
  std::vector<Number> large_;
};

template <int rows, int columns>
void multiply(const Eigen::MatrixXd& whitening, const double* raw, double* out, int stride) {
  const Eigen::Map<const Eigen::Matrix<double, rows, rows>> w(whitening.data());
  const Eigen::Map<const Eigen::Matrix<double, rows, columns, Eigen::RowMajor>> j(raw);
  Eigen::Map<Eigen::Matrix<double, rows, columns, Eigen::RowMajor>, 0, Eigen::OuterStride<>> product(
      out, Eigen::OuterStride<>(stride));
  product.noalias() = w.lazyProduct(j);
}

void multiplyAnySize(const Eigen::MatrixXd& whitening, const double* raw, int columns, double* out, int stride) {
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(
      raw, whitening.rows(), columns);
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0, Eigen::OuterStride<>> product(
      out, whitening.rows(), columns, Eigen::OuterStride<>(stride));
  product.noalias() = whitening.lazyProduct(j);
}

}  // namespace

bool takes(std::string_view slot_kind, std::string_view variable_kind) {
  return slot_kind == variable_kind || (slot_kind == "se3" && variable_kind == "se2");
}

BoundFactor::BoundFactor(const Graph& graph, const FactorRecord& record)
    : record_(&record), rows_(record.factor->residualSize()) {
  const std::vector<std::string_view>& kinds = record.factor->variableKinds();
  int size = rows_;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const Variable& bound = *graph.variable(record.variables[i]).kind;
    Slot slot;
    slot.bound_ambient = bound.ambientSize();
    slot.bound_tangent = bound.tangentSize();
    slot.lifted = kinds[i] != bound.kind();
    slot.factor_ambient = slot.lifted ? se3()->ambientSize() : slot.bound_ambient;
    slot.factor_tangent = slot.lifted ? se3()->tangentSize() : slot.bound_tangent;
    slot.jacobian_offset = size;
    size += rows_ * slot.factor_tangent;
    slot.value_offset = size;
    if (slot.lifted) size += slot.factor_ambient;
    slots_.push_back(slot);
  }
  scratch_size_ = size;
}

void BoundFactor::whiten(const double* raw, int raw_columns, bool lifted, double* out, int out_stride,
                         int out_columns) const {
  const Eigen::MatrixXd& w = record_->noise.matrix();
  if (lifted) {
    Scratch<double, 32> picked(3 * rows_);
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < 3; ++column)
        picked.data()[3 * row + column] = raw[raw_columns * row + kLiftedColumns[column]];
    whiten(picked.data(), 3, false, out, out_stride, 3);
  } else if (rows_ == 3 && out_columns == 3) {
    multiply<3, 3>(w, raw, out, out_stride);
  } else if (rows_ == 6 && out_columns == 6) {
    multiply<6, 6>(w, raw, out, out_stride);
  } else if (rows_ == 6 && out_columns == 3) {
    multiply<6, 3>(w, raw, out, out_stride);
  } else if (rows_ == 3 && out_columns == 6) {
    multiply<3, 6>(w, raw, out, out_stride);
  } else {
    multiplyAnySize(w, raw, out_columns, out, out_stride);
  }
}

void BoundFactor::evaluate(const double* const* values, double* residual, double* const* jacobians,
                           const int* strides) const {
  const int count = variableCount();
  Scratch<double, 256> scratch(scratch_size_);
  Scratch<const double*, 8> value_scratch(count);
  Scratch<double*, 8> jacobian_scratch(count);
  double* const memory = scratch.data();
  const double** const slot_values = value_scratch.data();
  double** const slot_jacobians = jacobian_scratch.data();
  for (int i = 0; i < count; ++i) {
    const Slot& slot = slots_[i];
    slot_values[i] = values[i];
    slot_jacobians[i] = jacobians && jacobians[i] ? memory + slot.jacobian_offset : nullptr;
    if (slot.lifted) {
      Eigen::Map<Eigen::Matrix<double, 7, 1>>{memory + slot.value_offset} =
          toValue(geometry::lift(se2FromValue(values[i])));
      slot_values[i] = memory + slot.value_offset;
    }
  }
  record_->factor->evaluate(slot_values, memory, jacobians ? slot_jacobians : nullptr);
  const Eigen::MatrixXd& w = record_->noise.matrix();
  Eigen::Map<Eigen::VectorXd>(residual, rows_).noalias() =
      w.lazyProduct(Eigen::Map<const Eigen::VectorXd>(memory, rows_));
  if (!jacobians) return;
  for (int i = 0; i < count; ++i)
    if (jacobians[i])
      whiten(slot_jacobians[i], slots_[i].factor_tangent, slots_[i].lifted, jacobians[i], strides[i],
             slots_[i].bound_tangent);
}

}  // namespace omnimapper::graph

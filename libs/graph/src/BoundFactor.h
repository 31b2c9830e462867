#pragma once

#include <vector>

#include "omnimapper/graph/FactorRecord.h"
#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Whether a slot for variables of one kind takes a variable of the other kind.
bool takes(std::string_view slot_kind, std::string_view variable_kind);

/// A factor with the kinds of the variables that are bound to it. It lifts planar poses for slots that take poses in
/// space, and whitens. It refers to the record, which must outlive it.
class BoundFactor {
 public:
  BoundFactor(const Graph& graph, const FactorRecord& record);

  int residualSize() const { return rows_; }
  int variableCount() const { return static_cast<int>(slots_.size()); }
  /// Sizes of the bound variable, not of the factor's slot.
  int tangentSize(int i) const { return slots_[i].bound_tangent; }
  int ambientSize(int i) const { return slots_[i].bound_ambient; }
  const FactorRecord& record() const { return *record_; }

  /// Whitened residual [residualSize] at the ambient values of the bound variables.
  /// jacobians may be null; jacobians[i], where not null, is row-major with residualSize rows, strides[i] numbers from
  /// one row to the next; the first tangentSize(i) of each row are written: the whitened derivative by the tangent.
  void evaluate(const double* const* values, double* residual, double* const* jacobians, const int* strides) const;

 private:
  struct Slot {
    int bound_ambient, bound_tangent;
    int factor_ambient, factor_tangent;
    bool lifted;
    int jacobian_offset;  // of the factor's own Jacobian in the scratch memory
    int value_offset;     // of the lifted value in the scratch memory
  };
  void whiten(const double* raw, int raw_columns, bool lifted, double* out, int out_stride, int out_columns) const;

  const FactorRecord* record_;
  int rows_;
  int scratch_size_;
  std::vector<Slot> slots_;
};

}  // namespace omnimapper::graph

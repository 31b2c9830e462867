#pragma once

#include <string_view>

namespace omnimapper::graph {

/// A kind of variable: the manifold its values live on. Stateless; the Graph keeps the values.
class Variable {
 public:
  virtual ~Variable() = default;
  /// Name in files, unique among kinds: "se2", "se3", "point3".
  virtual std::string_view kind() const = 0;
  /// Numbers that store a value.
  virtual int ambientSize() const = 0;
  /// Degrees of freedom.
  virtual int tangentSize() const = 0;
  /// y = x plus delta. x, y [ambientSize], delta [tangentSize]; y may be x.
  virtual void plus(const double* x, const double* delta, double* y) const = 0;
  /// delta such that y = x plus delta.
  virtual void minus(const double* y, const double* x, double* delta) const = 0;
};

}  // namespace omnimapper::graph

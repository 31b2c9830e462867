#pragma once

#include <Eigen/Core>
#include <string_view>

namespace omnimapper::graph {

/// A kind of variable: how many numbers store a value, and how a small change is applied to the value (a manifold).
/// Objects of this class have no state; the Graph keeps the values.
class Variable {
 public:
  virtual ~Variable() = default;
  /// Name in files, unique among kinds: "se2", "se3", "point3".
  virtual std::string_view kind() const = 0;
  /// Number of numbers that store a value.
  virtual int ambientSize() const = 0;
  /// Degrees of freedom.
  virtual int tangentSize() const = 0;
  /// y = x plus delta. x and y are [ambientSize] and may be the same array; delta is [tangentSize].
  virtual void plus(const double* x, const double* delta, double* y) const = 0;
  /// The delta for which y = x plus delta.
  virtual void minus(const double* y, const double* x, double* delta) const = 0;
  /// For a kind whose values are lines on the floor or planes in space: the line (nx ny d) or plane (nx ny nz d) of a
  /// value, that is, the points p of the map with n . p + d = 0, where |n| = 1. Empty for other kinds. It is used for
  /// files that other programs read.
  virtual Eigen::VectorXd hyperplane(const double*) const { return {}; }
};

}  // namespace omnimapper::graph

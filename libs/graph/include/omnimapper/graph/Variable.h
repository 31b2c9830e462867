#pragma once

#include <Eigen/Core>
#include <string_view>

namespace omnimapper::graph {

/// A kind of variable: the manifold its values live on. Stateless; the Graph keeps the values.
class Variable {
 public:
  virtual ~Variable() = default;
  /// Name in files, unique among kinds: "se2", "se3", "point3".
  virtual std::string_view kind() const = 0;
  /// How many numbers store a value.
  virtual int ambientSize() const = 0;
  /// Degrees of freedom.
  virtual int tangentSize() const = 0;
  /// y = x plus delta. x, y [ambientSize], delta [tangentSize]; y may be x.
  virtual void plus(const double* x, const double* delta, double* y) const = 0;
  /// delta such that y = x plus delta.
  virtual void minus(const double* y, const double* x, double* delta) const = 0;
  /// The line on the floor (nx ny d) or the plane in space (nx ny nz d) that a value describes: the points p of the map
  /// with n . p + d = 0, where |n| = 1. Empty for other kinds. Used for files that other programs read.
  virtual Eigen::VectorXd hyperplane(const double*) const { return {}; }
};

}  // namespace omnimapper::graph

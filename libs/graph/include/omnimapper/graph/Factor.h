#pragma once

#include <iosfwd>
#include <string_view>
#include <vector>

namespace omnimapper::graph {

/// A measurement as a pure function of the values of its variables: the residual before whitening.
/// The FactorRecord around it keeps which variables it binds, how much it is trusted and which loss it gets.
class Factor {
 public:
  virtual ~Factor() = default;
  /// Name in files, unique among factors: "between_se2", "prior_se3", ...
  virtual std::string_view kind() const = 0;
  /// Rows of the residual.
  virtual int residualSize() const = 0;
  /// Kinds of the variables it takes, in order (Variable::kind()). An "se3" slot also takes an "se2" variable: the
  /// graph then lifts the planar pose into space and uses the Jacobian's columns x, y and yaw only.
  virtual const std::vector<std::string_view>& variableKinds() const = 0;
  /// values[i]: ambient value of variable i. residual [residualSize].
  /// jacobians may be null; jacobians[i], where not null, is [residualSize x tangentSize of variable i], row-major:
  /// the derivative of the residual by the tangent (delta of Variable::plus) at zero.
  virtual void evaluate(const double* const* values, double* residual, double* const* jacobians) const = 0;
  /// Writes its measurement with ByteIo.h; the reader that a FactorRegistry holds for this kind() reads it back.
  virtual void write(std::ostream& out) const = 0;
};

}  // namespace omnimapper::graph

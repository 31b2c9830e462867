#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <optional>
#include <string_view>
#include <vector>

namespace omnimapper::graph {

/// A measurement as a pure function of the values of its variables: the residual before whitening (Noise.h). The
/// FactorRecord of a factor keeps which variables the factor binds, how much it is trusted, and its loss.
class Factor {
 public:
  virtual ~Factor() = default;
  /// Name in files, unique among factors: "between_se2", "prior_se3", ...
  virtual std::string_view kind() const = 0;
  /// Number of rows of the residual.
  virtual int residualSize() const = 0;
  /// Kinds of the variables that the factor takes, in order (Variable::kind()). Where the kind is "se3", an "se2"
  /// variable is taken as well: the graph then lifts the planar pose into space and uses only the Jacobian's columns x,
  /// y and yaw.
  virtual const std::vector<std::string_view>& variableKinds() const = 0;
  /// values[i]: the numbers of variable i [ambientSize]. residual: [residualSize]. jacobians may be null, and so may
  /// each jacobians[i]; otherwise jacobians[i] is [residualSize x tangentSize of variable i], row-major: the derivative
  /// of the residual by the change `delta` of Variable::plus(), at delta = 0.
  virtual void evaluate(const double* const* values, double* residual, double* const* jacobians) const = 0;
  /// What the consistency test (Consistency.h) must know of a hypothesis: the volume in which the measurement may lie
  /// if the hypothesis is false and relates two arbitrary places of the map, in the units of the residual, times the
  /// prior odds that the hypothesis is true. `map_size`: extent of the map along its axes [m]. None if it is not known
  /// how false measurements are distributed; the test then applies its gate alone.
  virtual std::optional<double> outlierVolume(const Eigen::Vector3d& /*map_size*/) const { return std::nullopt; }
  /// Writes the measurement with ByteIo.h. The reader that a FactorRegistry holds for this kind() reads it back.
  virtual void write(std::ostream& out) const = 0;
};

}  // namespace omnimapper::graph

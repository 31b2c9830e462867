#pragma once

#include <cstdint>

namespace omnimapper::graph {

/// A robust loss, which limits the cost of an outlier. It is a function rho of s, the squared norm of the whitened
/// residual; its scale c is a number of standard deviations. Near 0 every rho is s (rho(0) = 0, rho'(0) = 1), so
/// inliers keep their chi-square.
///
/// | kind   | rho(s)                                             | rho'(s)              |
/// |--------|----------------------------------------------------|----------------------|
/// | none   | s                                                  | 1                    |
/// | huber  | s for s <= c^2, else 2 c sqrt(s) - c^2             | 1, else c / sqrt(s)  |
/// | cauchy | c^2 log(1 + s / c^2)                               | 1 / (1 + s / c^2)    |
/// | tukey  | c^2 / 3 (1 - (1 - s / c^2)^3) for s <= c^2, else c^2 / 3 | (1 - s / c^2)^2, else 0 |
class Loss {
 public:
  /// These numbers are written to files.
  enum class Kind : std::uint8_t { none = 0, huber = 1, cauchy = 2, tukey = 3 };
  struct Value {
    double rho = 0, first_derivative = 1, second_derivative = 0;
  };

  Loss() = default;
  /// Throws Error(internal) if the scale is not positive and finite. `none` has no scale.
  Loss(Kind kind, double scale_sigmas);
  static Loss none() { return {}; }
  static Loss huber(double scale_sigmas) { return {Kind::huber, scale_sigmas}; }
  static Loss cauchy(double scale_sigmas) { return {Kind::cauchy, scale_sigmas}; }
  static Loss tukey(double scale_sigmas) { return {Kind::tukey, scale_sigmas}; }

  Kind kind() const { return kind_; }
  double scale() const { return scale_; }
  Value evaluate(double s) const;

 private:
  Kind kind_ = Kind::none;
  double scale_ = 1;
};

}  // namespace omnimapper::graph

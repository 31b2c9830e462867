#include "omnimapper/graph/ChiSquare.h"

#include <cmath>

namespace omnimapper::graph {

namespace {

/// Regularised lower incomplete gamma function P(a, x), by its series: all terms positive, good for every x that a gate
/// can have.
double lowerGamma(double a, double x) {
  if (x <= 0) return 0;
  double term = 1 / a, sum = term;
  for (double n = a + 1; term > 1e-17 * sum; ++n) {
    term *= x / n;
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

}  // namespace

double chiSquareQuantile(double probability, int degrees_of_freedom) {
  const double a = 0.5 * degrees_of_freedom;
  double low = 0, high = degrees_of_freedom + 10;
  while (lowerGamma(a, 0.5 * high) < probability && high < 1e6) high *= 2;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (lowerGamma(a, 0.5 * middle) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace omnimapper::graph

#pragma once

namespace omnimapper::graph {

/// The number below which a chi-square variable of `degrees_of_freedom` lies with the given probability. Throws
/// std::overflow_error if the probability is 1. Throws std::domain_error if the probability is below 0 or above 1, or
/// if `degrees_of_freedom` is not positive.
double chiSquareQuantile(double probability, int degrees_of_freedom);

}  // namespace omnimapper::graph

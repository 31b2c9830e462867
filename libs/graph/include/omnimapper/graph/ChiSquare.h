#pragma once

namespace omnimapper::graph {

/// The number below which a chi-square variable of `degrees_of_freedom` lies with the given probability. Throws
/// std::overflow_error if the probability is 1, and std::domain_error if it is otherwise outside [0, 1) or if
/// `degrees_of_freedom` is not positive.
double chiSquareQuantile(double probability, int degrees_of_freedom);

}  // namespace omnimapper::graph

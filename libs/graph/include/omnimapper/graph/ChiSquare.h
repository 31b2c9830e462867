#pragma once

namespace omnimapper::graph {

/// The number below which a chi-square variable of `degrees_of_freedom` lies with the given probability. Throws
/// std::domain_error or, of a certainty, std::overflow_error unless the probability is in [0, 1) and there is a degree.
double chiSquareQuantile(double probability, int degrees_of_freedom);

}  // namespace omnimapper::graph

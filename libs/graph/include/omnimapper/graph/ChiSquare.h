#pragma once

namespace omnimapper::graph {

/// The number below which a chi-square variable of so many degrees of freedom lies with the given probability, in
/// (0, 1), to 1e-9 of itself.
double chiSquareQuantile(double probability, int degrees_of_freedom);

}  // namespace omnimapper::graph

#pragma once

#include <vector>

namespace omnimapper::signs {

/// Probability 1 / (1 + exp(slope y + offset)).
struct PlattScaling {
  double slope = -1, offset = 0;
};

/// Fits it to values y of a classifier for signs and for others, both classes weighing the same, by Newton's method
/// with backtracking (Lin, Lin, Weng 2007). Neither may be empty.
PlattScaling fitPlatt(const std::vector<double>& of_signs, const std::vector<double>& of_others);

}  // namespace omnimapper::signs

#pragma once

#include <vector>

namespace omnimapper::signs {

/// A classifier's decision value y has the probability 1 / (1 + exp(slope y + offset)).
struct PlattScaling {
  double slope = -1, offset = 0;
};

/// Fits the scaling to the decision values of signs and of others, with equal weight for both classes, by Newton's
/// method with backtracking (Lin, Lin, Weng 2007). Neither list may be empty.
PlattScaling fitPlatt(const std::vector<double>& of_signs, const std::vector<double>& of_others);

}  // namespace omnimapper::signs

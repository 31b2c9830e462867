#pragma once

namespace omnimapper::signs {

/// Factor from a number of a histogram, which the normalization of blocks keeps below 0.5, to its byte.
constexpr float kFeatureScale = 510;

}  // namespace omnimapper::signs

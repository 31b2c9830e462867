#pragma once

namespace omnimapper::signs {

/// A number of a histogram, which normalised blocks keep below 0.5, times this is its byte.
constexpr float kFeatureScale = 510;

}  // namespace omnimapper::signs

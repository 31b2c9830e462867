#pragma once

#include <omnimapper/plugin/View.h>

#include <string>

namespace omnimapper::plugins {

/// Curves of the error: the cost at each solve, and each number in the decisions over the key frames.
std::string drawErrorCurves(const mapper::View& view);
/// Curves of computing time per key frame, and the total of each stage.
std::string drawTimeCurves(const mapper::View& view);

}  // namespace omnimapper::plugins

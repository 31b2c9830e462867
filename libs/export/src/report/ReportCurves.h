#pragma once

#include <omnimapper/plugin/View.h>

#include <string>

namespace omnimapper::exports {

/// Curves of error: the cost over the solves, and each number that decisions were made on, per key frame.
std::string drawErrorCurves(const mapper::View& view);
/// Curves of time: per key frame, and the total of each stage.
std::string drawTimeCurves(const mapper::View& view);

}  // namespace omnimapper::exports

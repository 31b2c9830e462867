#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// The upper and the lower part of a text that may be two lines: between them is a row that changes less along its
/// length than rows above and below. Each is as wide as what is in it. None where there is no such row, or the text is
/// so small that this cannot be told.
std::vector<Corners> partsOf(const cv::Mat& picture, const Corners& text);

}  // namespace omnimapper::signs

#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// The upper and the lower part of a text that may be two lines. Between them is a row whose grey levels change less
/// along it than those of the rows above and below. Each part is as wide as its content. None if there is no such row,
/// or the text is too small to decide.
std::vector<Corners> partsOf(const cv::Mat& picture, const Corners& text);

}  // namespace omnimapper::signs

#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// A quadrilateral of four straight edges.
struct Outline {
  Corners quad;                            ///< [px]
  double mean_edge = 0, weakest_edge = 0;  ///< share of a side that is an edge: mean and smallest of the four
};

/// Outlines around a line of text, in no particular order. At least half of each side is an edge, and they reach beyond
/// the text by at most seven times its height.
std::vector<Outline> outlinesAbout(const cv::Mat& picture, const Corners& text);

/// Moves each side of an outline to the strongest straight edge that is at most `reach` [px] away; a side without such
/// an edge stays as it is.
Corners refined(const cv::Mat& picture, const Corners& outline, float reach);

}  // namespace omnimapper::signs

#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// A quadrilateral of four straight edges.
struct Outline {
  Corners quad;                            ///< [px]
  double mean_edge = 0, weakest_edge = 0;  ///< shares of its sides that are edges: of all four, of the least
};

/// Those about a line of text, in no order, none with a side of which less than half is an edge. They reach at most
/// seven times the text's height beyond it.
std::vector<Outline> outlinesAbout(const cv::Mat& picture, const Corners& text);

/// The quadrilateral whose sides lie on the strongest edges that are at most `reach` [px] from those of this one; a
/// side that no straight edge is along stays as it is.
Corners refined(const cv::Mat& picture, const Corners& outline, float reach);

}  // namespace omnimapper::signs

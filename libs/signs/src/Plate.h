#pragma once

#include <omnimapper/signs/SignDetector.h>

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace omnimapper::signs {

/// The flat thing around a box of a picture that differs in colour from what is around it: the component of what
/// differs from the rim of the box's surroundings that covers most of the box, and the outermost points of its convex
/// hull towards each corner. `surroundings`: how far they reach to all sides, in the box's longer side. None where
/// nothing differs.
std::optional<Corners> findPlate(const cv::Mat& pixels, const cv::Rect2f& box, double surroundings);

/// The outermost of the points, middles of pixels, towards each corner.
Corners outermostCorners(const std::vector<cv::Point>& points);

/// The smallest upright rectangle around it [px].
cv::Rect2f boundsOf(const Corners& corners);
/// Area that two share over the area of both together.
double overlapOf(const cv::Rect2f& a, const cv::Rect2f& b);

}  // namespace omnimapper::signs

#pragma once

#include <omnimapper/signs/SignDetector.h>

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace omnimapper::signs {

/// Finds the plate around a box of a picture by its colour: of the connected components that differ from the rim of the
/// box's surroundings, the one that covers most of the box. The corners are its outermost points towards each corner.
/// `surroundings` is the margin around the box, relative to its size. None if nothing differs from the rim.
std::optional<Corners> findPlate(const cv::Mat& pixels, const cv::Rect2f& box, double surroundings);

/// The outermost of the points (middles of pixels) towards each corner.
Corners outermostCorners(const std::vector<cv::Point>& points);

/// The smallest upright rectangle around the corners [px].
cv::Rect2f boundsOf(const Corners& corners);
/// Intersection over union of two rectangles.
double overlapOf(const cv::Rect2f& a, const cv::Rect2f& b);

}  // namespace omnimapper::signs

#pragma once

#include <omnimapper/signs/SignDetector.h>

#include <Eigen/Core>

namespace omnimapper::signs {

/// The height is the mean length [px] of the left and the right side, the width that of the upper and the lower side.
float heightOf(const Corners& quad);
float widthOf(const Corners& quad);

/// Area [px^2] of a convex quadrilateral.
float areaOf(const Corners& quad);

Eigen::Vector2f middleOf(const Corners& quad);

/// Whether a point is in a convex quadrilateral.
bool contains(const Corners& quad, const Eigen::Vector2f& point);

/// Margins on each side of a quadrilateral, as shares of its height.
struct Margins {
  float left = 0, right = 0, up = 0, down = 0;
};
Corners grown(const Corners& quad, const Margins& margins);

}  // namespace omnimapper::signs

#pragma once

#include <omnimapper/signs/SignDetector.h>

#include <Eigen/Core>

namespace omnimapper::signs {

/// Means of the lengths [px] of its left and right, and of its upper and lower side.
float heightOf(const Corners& quad);
float widthOf(const Corners& quad);

/// [px^2] of a convex one.
float areaOf(const Corners& quad);

Eigen::Vector2f middleOf(const Corners& quad);

/// Whether a point is within a convex one.
bool contains(const Corners& quad, const Eigen::Vector2f& point);

/// Larger by these shares of its height on each side.
struct Margins {
  float left = 0, right = 0, up = 0, down = 0;
};
Corners grown(const Corners& quad, const Margins& margins);

}  // namespace omnimapper::signs

#pragma once

#include <Eigen/Core>
#include <array>

namespace omnimapper::signs {

/// Corners in an image [px]: upper left, upper right, lower right, lower left, as the text in it is read; x to the
/// right and y down, (0, 0) the middle of the upper left pixel.
using Quad = std::array<Eigen::Vector2f, 4>;

/// Means of the lengths [px] of its left and right, and of its upper and lower side.
float heightOf(const Quad& quad);
float widthOf(const Quad& quad);

/// [px^2] of a convex one.
float areaOf(const Quad& quad);

Eigen::Vector2f middleOf(const Quad& quad);

/// Whether a point is within a convex one.
bool contains(const Quad& quad, const Eigen::Vector2f& point);

/// Larger by these shares of its height on each side.
struct Margins {
  float left = 0, right = 0, up = 0, down = 0;
};
Quad grown(const Quad& quad, const Margins& margins);

}  // namespace omnimapper::signs

#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace omnimapper::sim {

using Ring = std::vector<Eigen::Vector2d>;  ///< a closed line, the last point joined to the first [m]

/// Twice the area of a ring, positive if it is counter-clockwise [m^2].
double doubleArea(const Ring& ring);

/// Divides a polygon with holes into triangles, by clipping ears (Eberly: Triangulation by Ear Clipping, 2002).
/// rings[0] is the outline, the others are holes strictly inside it that do not touch; all are simple, in any sense of
/// rotation. Corners are numbered through the rings one after the other; the triangles are counter-clockwise, and none
/// has an area of 0. Throws std::invalid_argument if the rings violate this.
std::vector<std::array<int, 3>> triangulate(const std::vector<Ring>& rings);

}  // namespace omnimapper::sim

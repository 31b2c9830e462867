#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace omnimapper::sim {

using Ring = std::vector<Eigen::Vector2d>;  ///< a closed line, the last point joined to the first [m]

/// Twice the area a ring goes round, positive if counter-clockwise [m^2].
double doubleArea(const Ring& ring);

/// A polygon with holes as triangles, by clipping ears (Eberly: Triangulation by Ear Clipping, 2002). ring[0] is the
/// outline, the others are holes strictly inside it that do not touch; all simple, in any sense of rotation. Corners
/// count through the rings one after the other; the triangles are counter-clockwise, none has an area of 0.
/// Throws std::invalid_argument if the rings are not so.
std::vector<std::array<int, 3>> triangulate(const std::vector<Ring>& rings);

}  // namespace omnimapper::sim

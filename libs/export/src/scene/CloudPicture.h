#pragma once

#include <omnimapper/map/Map.h>

#include <optional>
#include <vector>

#include "grid/GridPicture.h"

namespace omnimapper::exports {

/// The points of depth images from above, in the camera's colours, higher ones over lower ones: the ground for a map
/// that has no scans. Points half a metre higher than the base and than half of all points are left out, or ceilings
/// would cover all. Shown are all but the outermost 0.5 % to each side, and the places [m] too; the longer side has
/// about `side` pixels. None without such points.
std::optional<GridPicture> cloudPicture(const map::Map& map, const std::vector<mrpt::math::TPoint3D>& places, int side);

}  // namespace omnimapper::exports

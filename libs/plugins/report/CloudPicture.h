#pragma once

#include <omnimapper/derived/GridPicture.h>
#include <omnimapper/map/Map.h>

#include <optional>
#include <vector>

namespace omnimapper::plugins {

/// The points of depth images from above in the camera's colours, higher ones over lower ones: the background for a map
/// without scans. Points more than half a metre above both the base and the median height of the points are left out,
/// because ceilings would hide everything. The picture contains the places [m] and all points but the outermost 0.5 %
/// at each side; its longer side has about `side` pixels. None without such points.
std::optional<derived::GridPicture> cloudPicture(const map::Map& map, const std::vector<mrpt::math::TPoint3D>& places,
                                                 int side);

}  // namespace omnimapper::plugins

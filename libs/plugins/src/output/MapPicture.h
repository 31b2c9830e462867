#pragma once

#include <omnimapper/map/Trajectory.h>

#include <optional>
#include <vector>

#include "Closures.h"
#include "GridPicture.h"

namespace omnimapper::plugins {

/// The map from above as a picture: the grid, the trajectory with its start (ring) and end (dot), accepted closures,
/// a scale bar.
Image drawMap(const GridPicture& grid, const std::vector<map::StampedPose>& trajectory,
              const std::vector<Closure>& closures);

/// A picture without a wall, of the size of the trajectory and `margin` [m] around it, `side` pixels at most: the
/// ground for a map that has no scans. None for an empty trajectory.
std::optional<GridPicture> emptyPicture(const std::vector<map::StampedPose>& trajectory, double margin, int side);

/// The trajectory in pixels, a path for each session, without the points that change its course by less than
/// `tolerance` [pixels].
std::vector<std::vector<PixelPoint>> simplifiedPaths(const GridPicture& grid,
                                                     const std::vector<map::StampedPose>& trajectory, double tolerance);

}  // namespace omnimapper::plugins

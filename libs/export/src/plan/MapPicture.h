#pragma once

#include <omnimapper/map/DenseTrajectory.h>

#include <optional>
#include <vector>

#include "grid/GridPicture.h"
#include "plan/LandmarkShapes.h"
#include "run/Closures.h"

namespace omnimapper::exports {

/// The map from above as a picture: the grid, landmarks (what stands upright as thick lines (thin ones where it was
/// hardly seen), all else but floors and ceilings as areas, in the colours of LandmarkColours.h; broken lines where
/// they have moved), the trajectory with its start (ring) and end (dot), accepted closures, a scale bar.
draw::Image drawMap(const GridPicture& grid, const std::vector<ShapedLandmark>& landmarks,
                    const std::vector<map::StampedPose>& trajectory, const std::vector<Closure>& closures);

/// What a picture of the map must not leave out: poses, and the corners of landmarks [m].
std::vector<mrpt::math::TPoint3D> placesOf(const std::vector<map::StampedPose>& trajectory,
                                           const std::vector<ShapedLandmark>& landmarks);

/// A picture without a wall, of the size of the trajectory and the landmarks and `margin` [m] around them, `side`
/// pixels at most: the ground for a map that has no scans. None if there is neither.
std::optional<GridPicture> emptyPicture(const std::vector<map::StampedPose>& trajectory,
                                        const std::vector<ShapedLandmark>& landmarks, double margin, int side);

/// The trajectory in pixels, a path for each session, without the points that change its course by less than
/// `tolerance` [pixels].
std::vector<std::vector<draw::PixelPoint>> simplifiedPaths(const GridPicture& grid,
                                                           const std::vector<map::StampedPose>& trajectory,
                                                           double tolerance);

}  // namespace omnimapper::exports

#pragma once

#include <omnimapper/map/DenseTrajectory.h>

#include <optional>
#include <vector>

#include "grid/GridPicture.h"
#include "plan/LandmarkShapes.h"
#include "run/Closures.h"

namespace omnimapper::exports {

/// The map from above as a picture: the grid; landmarks in the colours of LandmarkColours.h, upright ones as thick
/// lines (thin if they were rarely measured), all others but floors and ceilings as areas, moved ones dashed; the
/// trajectory with its start (ring) and end (dot); accepted closures; a scale bar.
draw::Image drawMap(const GridPicture& grid, const std::vector<ShapedLandmark>& landmarks,
                    const std::vector<map::StampedPose>& trajectory, const std::vector<Closure>& closures);

/// The positions that a picture of the map must contain: poses and the corners of landmarks [m].
std::vector<mrpt::math::TPoint3D> placesOf(const std::vector<map::StampedPose>& trajectory,
                                           const std::vector<ShapedLandmark>& landmarks);

/// An empty picture that covers the trajectory and the landmarks with a margin of `margin` [m], at most `side` pixels
/// long: the background for a map without scans. None if there are neither.
std::optional<GridPicture> emptyPicture(const std::vector<map::StampedPose>& trajectory,
                                        const std::vector<ShapedLandmark>& landmarks, double margin, int side);

/// The trajectory in pixels, one path for each session, without points that change it by less than `tolerance`
/// [pixels].
std::vector<std::vector<draw::PixelPoint>> simplifiedPaths(const GridPicture& grid,
                                                           const std::vector<map::StampedPose>& trajectory,
                                                           double tolerance);

}  // namespace omnimapper::exports

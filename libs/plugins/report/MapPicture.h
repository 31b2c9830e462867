#pragma once

#include <omnimapper/derived/Closures.h>
#include <omnimapper/derived/GridPicture.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <optional>
#include <vector>

namespace omnimapper::plugins {

/// The map from above as a picture: the grid; landmarks in the colours of LabelColours.h, upright ones as thick
/// lines (thin if they were rarely measured), all others but floors and ceilings as areas, moved ones dashed; the
/// trajectory with its start (ring) and end (dot) in the colours of SessionColours.h; accepted closures; a scale bar.
draw::Image drawMap(const derived::GridPicture& grid, const std::vector<derived::ShapedLandmark>& landmarks,
                    const std::vector<map::StampedPose>& trajectory, const std::vector<derived::Closure>& closures);

/// The positions that a picture of the map must contain: poses and the corners of landmarks [m].
std::vector<mrpt::math::TPoint3D> placesOf(const std::vector<map::StampedPose>& trajectory,
                                           const std::vector<derived::ShapedLandmark>& landmarks);

/// An empty picture that covers the trajectory and the landmarks with a margin of `margin` [m], at most `side` pixels
/// long: the background for a map without scans. None if there are neither.
std::optional<derived::GridPicture> emptyPicture(const std::vector<map::StampedPose>& trajectory,
                                                 const std::vector<derived::ShapedLandmark>& landmarks, double margin,
                                                 int side);

/// The trajectory of a session in pixels.
struct SessionPath {
  std::vector<draw::PixelPoint> points;
  bool is_newest = true;
};
/// One path for each session, without points that change it by less than `tolerance` [pixels].
std::vector<SessionPath> simplifiedPaths(const derived::GridPicture& grid,
                                         const std::vector<map::StampedPose>& trajectory, double tolerance);

}  // namespace omnimapper::plugins

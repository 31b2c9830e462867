#pragma once

#include <mrpt/math/TPoint3D.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/map/Map.h>

#include <vector>

#include "scene/PointsOutput.h"

namespace omnimapper::exports {

struct ColouredPoint {
  mrpt::math::TPoint3Df in_map;  ///< [m]
  draw::Rgb colour;
};

/// The points that a key frame saw, in the frame of its base [m]: of its point clouds if `of_clouds`, else of its 2D
/// scans. Points further than `max_range` [m] from their sensor are left out.
std::vector<mrpt::math::TPoint3Df> pointsInBase(const map::KeyFrame& frame, bool of_clouds, double max_range);
bool hasClouds(const map::KeyFrame& frame);
/// Whether any key frame has a point cloud: then those are the points of the map.
bool hasClouds(const map::Map& map);

/// Whether any key frame has points of depth images.
bool hasDepthClouds(const map::Map& map);

/// The points of all key frames, those of depth images first; of each cube the first is kept. Where these have the
/// colours of the camera, the others are grey.
std::vector<ColouredPoint> pointsOf(const map::Map& map, const PointsOptions& options);

/// Colours from blue by green to red for 0 to 1.
draw::Rgb spectrum(double fraction);

}  // namespace omnimapper::exports

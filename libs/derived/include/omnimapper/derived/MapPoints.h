#pragma once

#include <mrpt/math/TPoint3D.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/map/Map.h>

#include <vector>

namespace omnimapper::derived {

/// The meaning of point colours. automatic: the camera's colours if there are depth images, else height if the points
/// differ in height, else time.
enum class PointColour { automatic, height, time };

struct PointsOptions {
  double voxel = 0.05;      ///< [m] one point is kept in each cube of this side; 0: all are kept
  double max_range = 30.0;  ///< [m] largest distance from the sensor
  PointColour colour = PointColour::automatic;

  static const base::OptionTable<PointsOptions>& table();
};

struct ColouredPoint {
  mrpt::math::TPoint3Df in_map;  ///< [m]
  draw::Rgb colour;
};

/// The points measured at a key frame, in the base frame [m]: those of its point clouds if `of_clouds` is set, else of
/// its 2D scans. Points further than `max_range` [m] from their sensor are left out.
std::vector<mrpt::math::TPoint3Df> pointsInBase(const map::KeyFrame& frame, bool of_clouds, double max_range);
bool hasClouds(const map::KeyFrame& frame);
/// Whether any key frame has a point cloud: the points of the map are then taken from these.
bool hasClouds(const map::Map& map);

/// Whether any key frame has points of depth images.
bool hasDepthClouds(const map::Map& map);

/// The points of all key frames, those of depth images first; only the first one in each cube is kept. If depth images
/// give the camera's colours, the other points are grey.
std::vector<ColouredPoint> pointsOf(const map::Map& map, const PointsOptions& options);

/// Colours from blue over green to red for fractions from 0 to 1.
draw::Rgb spectrum(double fraction);

}  // namespace omnimapper::derived

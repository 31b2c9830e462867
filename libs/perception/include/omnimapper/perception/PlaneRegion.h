#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace omnimapper::perception {

/// The upper left corner of the pixel in column x and row y: the image point (x - 0.5, y - 0.5).
struct PixelCorner {
  int x = 0, y = 0;
  bool operator==(const PixelCorner& other) const { return x == other.x && y == other.y; }
};

/// A closed line along the edges of pixels, with a corner where it turns; the last is joined to the first. The region
/// lies on its left as the image is seen: outer lines run counter-clockwise, those around holes clockwise.
struct Contour {
  std::vector<PixelCorner> corners;
  /// [m], a vertex for each corner: where the ray through it meets the region's plane. Where it meets it beyond twice
  /// the largest depth, or never, since the pixel sees the plane edge-on, the vertex is that far along the ray, off the
  /// plane.
  geometry::Polygon3 polygon_in_sensor;
};

/// A connected part of the image that is flat to what the sensor can tell.
/// Frame: the camera's optical frame, x right, y down, z forward.
struct PlaneRegion {
  geometry::Plane3 plane_in_sensor;  ///< normal towards the sensor, distance > 0
  /// Of the two changes of the normal [rad] and that of the distance [m], as geometry/PlaneTangent.h defines them.
  /// Positive definite. It counts the noise of pixels, correlated among neighbours, the steps of the sensor, and what
  /// does not shrink with the number of pixels: DepthNoise::bend, which moves and turns the plane, and scale. These are
  /// alike in all views of one sensor: planes of several images agree better with one another than it says.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m], mean of the inliers, put on the plane
  int inliers = 0;                                     ///< pixels
  double rms = 0;                                      ///< [m], distance of the inliers from the plane
  /// By how many times more than the sensor's noise the inliers scatter about the plane, in inverse depth [-]; 0 for a
  /// sensor without noise.
  double roughness = 0;
  Contour outline;
  std::vector<Contour> holes;
};

struct PlaneSegmentation {
  int width = 0, height = 0;
  std::vector<std::uint16_t> labels;  ///< of each pixel, row by row: i + 1 on planes[i], 0 on none
  std::vector<PlaneRegion> planes;    ///< the one with most pixels first
};

}  // namespace omnimapper::perception

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

/// A closed line along the edges of pixels, with a corner wherever it turns; the last corner is joined to the first. As
/// seen in the image, the region lies to the left of the line: outer lines run counter-clockwise, lines around holes
/// clockwise.
struct Contour {
  std::vector<PixelCorner> corners;
  /// [m] One vertex for each corner: the point where the ray through the corner meets the region's plane. If this point
  /// is beyond twice the largest permitted depth (max_depth), or if the ray does not meet the plane because the pixel
  /// sees it edge-on, the vertex is the point on the ray at twice this depth and is not on the plane.
  geometry::Polygon3 polygon_in_sensor;
};

/// A connected part of the image that is flat within the accuracy of the sensor.
/// Frame: the camera's optical frame, x right, y down, z forward.
struct PlaneRegion {
  geometry::Plane3 plane_in_sensor;  ///< normal towards the sensor, distance > 0
  /// Covariance of the two changes of the normal [rad] and the change of the distance [m], which
  /// geometry/PlaneTangent.h defines. Positive definite. It includes the noise of pixels, correlated among neighbours,
  /// the steps of the sensor, and two errors that do not shrink with the number of pixels: DepthNoise::distortion,
  /// which moves and rotates the plane, and DepthNoise::scale. These two errors are alike in all images of one sensor,
  /// so that planes of several images agree better with one another than the covariance says.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m] mean of the inliers, projected onto the plane
  int inliers = 0;                                     ///< number of pixels
  double rms = 0;                                      ///< [m] root mean square distance of the inliers from the plane
  /// Scatter of the inliers about the plane in inverse depth, relative to the sensor's noise [-]; 0 for a sensor
  /// without noise.
  double roughness = 0;
  Contour outline;
  std::vector<Contour> holes;
};

struct PlaneSegmentation {
  int width = 0, height = 0;
  std::vector<std::uint16_t> labels;  ///< for each pixel, row by row: i + 1 if it lies on planes[i], 0 if on none
  std::vector<PlaneRegion> planes;    ///< the plane with the most inliers first
};

}  // namespace omnimapper::perception

#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>

#include <cstdint>
#include <vector>

namespace omnimapper::perception {

struct CloudPlaneOptions {
  enum class Outline { convex, concave };
  double voxel = 0.025;          ///< [m] points are averaged over cubes of that side; 0 leaves them as they are
  double min_range = 0.3;        ///< [m]
  double max_range = 100;        ///< [m]
  double range_sigma = 0.01;     ///< [m] standard deviation of a point along its ray, near the sensor
  double noise_at_1m = 0;        ///< [m] the same, for what grows with the square of the range: depth cameras
  double correlated_points = 1;  ///< neighbours that share an error: 9 for a Kinect
  double bias_sigma = 0.01;      ///< [m] of what all points are off along their rays
  double bend_at_1m = 0;         ///< [m] the most of the same that grows with the square of the range: depth cameras
  double scale_sigma = 0;        ///< [-] the same, for what grows with the range
  double gate = 3;               ///< standard deviations; a point farther from a plane than that is not on it
  double sample_radius = 0.3;    ///< [m] side of the cubes that three points are drawn from
  int trials = 300;              ///< most triples that are drawn for each plane
  int seed = 1;                  ///< of those triples
  double max_gap = 0.1;          ///< [m] of a surface; where a plane has larger ones, it is several
  double min_incidence = 2 * base::option_text::kRadiansPerDegree;  ///< [rad] between a plane and the rays to it
  int min_points = 150;                                             ///< points, after averaging, of a surface
  Outline outline = Outline::concave;

  static const base::OptionTable<CloudPlaneOptions>& table();
};

/// A connected flat part of a cloud, in the cloud's frame.
struct CloudPlane {
  geometry::Plane3 plane_in_sensor;  ///< normal towards the sensor, distance >= 0
  /// Of the two changes of the normal [rad] and that of the distance [m], as geometry/PlaneTangent.h defines them. By
  /// the noise of the points, however many were averaged, and by what they share, which does not average out.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m], mean of its points, put on the plane
  int inliers = 0;                                     ///< points, after averaging
  double rms = 0;                                      ///< [m], distance of those from the plane
  geometry::Polygon3 outline;                          ///< [m] on the plane, counter-clockwise against the normal
  std::vector<geometry::Polygon3> holes;               ///< of a concave outline
};

struct CloudPlanes {
  std::vector<std::uint16_t> labels;  ///< of each point: i + 1 on planes[i], 0 on none
  std::vector<CloudPlane> planes;     ///< in the order in which they were found: large ones first
};

/// Finds all planes of a cloud without order (thesis 3.3), such as those of 3D and tilting lasers or several views
/// merged: the plane through three random points that most points lie on, least squares, clusters of what lies on it,
/// each large one a surface; then the same with the points that are left, until no surface is large enough.
/// - The three points are neighbours: far ones hardly ever lie on one surface. Source: Myatt et al., NAPSAC: High
/// noise,
///   high dimensional robust estimation, BMVC 2002.
/// - How far a point may be from a plane is told by the noise of its range.
/// - A sensor sees no plane edge-on: but the points of one turn of a laser do lie on planes through it.
/// - A concave outline is that of the cells of `max_gap` that the points fill, drawn in to the points.
class CloudPlaneFinder {
 public:
  /// Throws Error(out_of_range) for min_range >= max_range.
  explicit CloudPlaneFinder(const CloudPlaneOptions& options);

  /// Points in the frame of the sensor that saw them [m]; what is not finite or out of range is left out. Thread-safe;
  /// the same points give the same bits.
  CloudPlanes find(const std::vector<Eigen::Vector3f>& points) const;

 private:
  CloudPlaneOptions options_;
};

}  // namespace omnimapper::perception

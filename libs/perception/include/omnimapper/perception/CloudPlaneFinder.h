#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>

#include <cstdint>
#include <vector>

namespace omnimapper::perception {

struct CloudPlaneOptions {
  enum class Outline { convex, concave };
  double voxel = 0.025;          ///< [m] side of the cubes over which points are averaged; 0 leaves them as they are
  double min_range = 0.3;        ///< [m]
  double max_range = 100;        ///< [m]
  double range_sigma = 0.01;     ///< [m] standard deviation of a point along its ray, near the sensor
  double noise_at_1m = 0;        ///< [m] the same at 1 m, for noise that grows with the squared range: depth cameras
  double correlated_points = 1;  ///< number of neighbours that share an error: 9 for a Kinect
  double bias_sigma = 0.01;      ///< [m] standard deviation of an error along their rays that points share
  double distortion_at_1m = 0;   ///< [m] two sigma of such an error at 1 m that grows with the squared range
  double scale_sigma = 0;        ///< [-] standard deviation of such an error, relative to the range
  double gate = 3;               ///< [-] standard deviations; a point farther from a plane is not on it
  double sample_radius = 0.3;    ///< [m] side of the cubes that three points are drawn from
  int trials = 300;              ///< largest number of triples that are drawn for each plane
  int seed = 1;                  ///< of the random numbers that draw them
  double max_gap = 0.1;          ///< [m] a plane with larger gaps is split into several surfaces
  double min_incidence = 2 * base::option_text::kRadiansPerDegree;  ///< [rad] between a plane and the rays to it
  int min_points = 150;  ///< least number of points of a surface, after averaging
  Outline outline = Outline::concave;

  static const base::OptionTable<CloudPlaneOptions>& table();
};

/// A connected flat part of a cloud, in the cloud's frame.
struct CloudPlane {
  geometry::Plane3 plane_in_sensor;  ///< normal towards the sensor, distance >= 0
  /// Covariance of the two changes of the normal [rad] and that of the distance [m], as geometry/PlaneTangent.h defines
  /// them. It includes the noise of the points, however many were averaged, and the errors that they share, which do
  /// not average out.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m] mean of its points, projected onto the plane
  int inliers = 0;                                     ///< points, after averaging
  double rms = 0;                                      ///< [m] distance of those from the plane
  geometry::Polygon3 outline;                          ///< [m] on the plane, counter-clockwise against the normal
  std::vector<geometry::Polygon3> holes;               ///< of a concave outline
};

struct CloudPlanes {
  std::vector<std::uint16_t> labels;  ///< of each point: i + 1 on planes[i], 0 if on none
  std::vector<CloudPlane> planes;     ///< in the order in which they were found: large ones first
};

/// Finds all planes of a cloud without order (thesis 3.3), such as that of a 3D laser, a tilting laser or several
/// merged views. It takes the plane through three random points that most points lie on, and refines it by least
/// squares. Each large cluster of points on that plane is a surface. The same is done with the remaining points until
/// no surface is large enough.
/// - The three points are neighbours, since distant ones hardly ever lie on one surface. Source: Myatt et al., NAPSAC:
///   High noise, high dimensional robust estimation, BMVC 2002.
/// - How far a point may be from a plane follows from the noise of its range.
/// - Planes that are seen edge-on are left out: a sensor sees no surface so, but the points of one turn of a laser lie
/// on
///   planes through the laser.
/// - A concave outline is that of the cells of side `max_gap` that the points fill, drawn in to the points.
class CloudPlaneFinder {
 public:
  /// Throws Error(out_of_range) for min_range >= max_range.
  explicit CloudPlaneFinder(const CloudPlaneOptions& options);

  /// Finds the planes of `points` [m], which are in the frame of the sensor that measured them. Points that are not
  /// finite or out of range are left out. Thread-safe; the same points give the same bits.
  CloudPlanes find(const std::vector<Eigen::Vector3f>& points) const;

 private:
  CloudPlaneOptions options_;
};

}  // namespace omnimapper::perception

#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>

#include <cstdint>
#include <vector>

namespace omnimapper::perception {

struct CloudPlaneOptions {
  enum class Outline { convex, concave };
  double voxel = 0.025;          ///< [m] side of the cubes over which points are averaged; 0: no averaging
  double min_range = 0.3;        ///< [m]
  double max_range = 100;        ///< [m]
  double range_sigma = 0.01;     ///< [m] standard deviation of a point along its ray, near the sensor
  double noise_at_1m = 0;        ///< [m] at 1 m: further noise along the ray, which grows with the squared range
  double correlated_points = 1;  ///< number of neighbouring points that share one error; 9 for a Kinect
  double bias_sigma = 0.01;      ///< [m] standard deviation of the error along the rays that neighbouring points share
  double distortion_at_1m = 0;   ///< [m] at 1 m: two sigma of a shared error that grows with the squared range
  double scale_sigma = 0;        ///< [-] standard deviation of a shared error that is proportional to the range
  double gate = 3;               ///< [-] standard deviations; a point farther from a plane is not on it
  double sample_cube = 0.3;      ///< [m] the three points that determine a plane are drawn from a cube with this side
  int trials = 300;              ///< largest number of triples that are drawn for each plane
  int seed = 1;                  ///< of the random numbers that draw the triples
  double max_gap = 0.1;          ///< [m] a plane with larger gaps is split into several surfaces
  /// [rad] Smallest angle between a plane and the rays to it.
  double min_incidence = 2 * base::option_text::kRadiansPerDegree;
  int min_points = 150;  ///< least number of points of a surface, after averaging
  Outline outline = Outline::concave;

  static const base::OptionTable<CloudPlaneOptions>& table();
};

/// A connected flat part of a cloud, in the cloud's frame.
struct CloudPlane {
  geometry::Plane3 plane_in_sensor;  ///< normal towards the sensor, distance >= 0
  /// Covariance of the two changes of the normal [rad] and the change of the distance [m], which
  /// geometry/PlaneTangent.h defines. It includes the noise of the points, which averages out, and the errors that
  /// neighbouring points share, which do not.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< [m] mean of the surface's points, projected onto the plane
  int inliers = 0;                                     ///< number of points, after averaging
  double rms = 0;                                      ///< [m] root mean square distance of these points from the plane
  geometry::Polygon3 outline;                          ///< [m] on the plane, counter-clockwise as seen from the sensor
  std::vector<geometry::Polygon3> holes;               ///< only if the outline is concave
};

struct CloudPlanes {
  std::vector<std::uint16_t> labels;  ///< for each point: i + 1 if it lies on planes[i], 0 if it lies on none
  std::vector<CloudPlane> planes;     ///< in the order in which they were found: large ones first
};

/// Finds all planes of a cloud without order (thesis 3.3), such as that of a 3D laser, a tilting laser or several
/// merged views. Of many planes through three random points, it takes the one on which most points lie, and refines
/// this plane by least squares. Each large cluster of points on the plane is a surface. The search is repeated with the
/// remaining points until no surface is large enough.
/// - The three points are neighbours, since distant ones hardly ever lie on one surface. Source: Myatt et al., NAPSAC:
///   High noise, high dimensional robust estimation, BMVC 2002.
/// - How far a point may be from a plane follows from the noise of its range.
/// - Planes that are seen edge-on are left out: no sensor can see a surface edge-on, but the points of one turn of a
///   laser lie on a plane through the laser.
/// - A concave outline is the outline of the square cells of side `max_gap` in which points lie, moved inwards to the
///   points.
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

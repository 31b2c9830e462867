#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <optional>
#include <vector>

namespace omnimapper::perception {

struct ObjectOptions {
  enum class Comparator { euclidean, locally_convex };
  Comparator comparator = Comparator::locally_convex;  ///< which neighbours belong to one object
  /// [rad] Concave edges sharper than this speak for two objects.
  double concave_angle = 30 * base::option_text::kRadiansPerDegree;
  double min_surface_area = 0.1;  ///< [m^2] larger planes belong to the environment, smaller ones to objects
  double max_tilt = 50 * base::option_text::kRadiansPerDegree;  ///< [rad] largest tilt of a supporting surface
  /// [rad] Largest angle between the normals of pieces of one surface.
  double coplanar_angle = 8 * base::option_text::kRadiansPerDegree;
  /// [m] Largest distance between pieces of one surface, in addition to the sensor's systematic distortion.
  double coplanar_distance = 0.01;
  double min_height = 0.005;  ///< [m] points may be above a surface by up to this plus the noise and still belong to it
  double max_gap = 0.02;      ///< [m] neighbours farther apart than this plus the noise belong to two objects
  /// [m] Largest distance from a surface to the lowest visible point of an object that stands on it. It is not 0
  /// because nearer objects may hide the object's foot.
  double max_standing_gap = 0.3;
  int min_points = 300;         ///< least number of points of an object
  double min_size = 0.03;       ///< [m] smallest length of the longest side of an object's box
  double max_volume = 1;        ///< [m^3] largest volume of an object's box
  double max_aspect_ratio = 4;  ///< largest ratio of an object's two longest sides, if it is longer than 0.35 m
  bool on_surfaces_only = true;

  static const base::OptionTable<ObjectOptions>& table();
};

/// An object as one depth image shows it. Frame: the camera's optical frame, x right, y down, z forward.
struct ObjectRegion {
  std::vector<int> pixels;                               ///< row by row, ascending
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();    ///< [m] mean of the object's points
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2] of the centroid, due to the errors in DepthNoise
  /// Middle and axes of the object's box. z is the normal of the surface on which the object stands; without such a
  /// surface, z is the direction in which the object's points are scattered least.
  geometry::Se3 sensor_from_box;
  /// [m] Full length along each axis. The box reaches down to the surface unless the gap to the lowest visible points
  /// is larger than 0.03 m plus the noise.
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();
  std::optional<int> surface;  ///< index of the plane on which the object stands
};

/// Finds the objects on tables, shelves and floors (thesis 3.4.6 and 3.5.1.2). The points of a depth image that lie on
/// none of its large planes form clusters. Clusters of the right size that stand on a level surface are objects.
/// Because a Kinect's systematic distortion breaks a table into several planes, pieces that lie in one plane count as
/// one surface. Clusters that are rests of walls, or long and thin as legs and plinths are, are no objects.
class ObjectFinder {
 public:
  /// Throws Error(out_of_range) unless 0 < min_depth < max_depth, for `min_points` or `max_aspect_ratio` below 1, and
  /// for areas, volumes or lengths that are negative or not finite.
  ObjectFinder(const ObjectOptions& options, const PlaneOptions& sensor);

  /// Returns the objects, sorted by number of pixels with the largest first; an image without pixels has no objects.
  /// `planes` are those that a PlaneSegmenter with the same PlaneOptions found in this image. `up` is a unit vector in
  /// the optical frame. Throws Error(unreadable_input) if the planes are those of an image of another size.
  /// Thread-safe; the same input gives the same bits.
  std::vector<ObjectRegion> find(const camera::DepthImage& image, const PlaneSegmentation& planes,
                                 const Eigen::Vector3d& up) const;
  /// Whether any of these planes is a level surface that objects may stand on.
  bool hasSurface(const PlaneSegmentation& planes, const Eigen::Vector3d& up) const;

 private:
  ObjectOptions options_;
  PlaneOptions sensor_;
};

}  // namespace omnimapper::perception

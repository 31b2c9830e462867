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
  double min_surface_area = 0.1;  ///< [m^2] planes as large belong to the environment, smaller ones to objects
  double max_tilt = 50 * base::option_text::kRadiansPerDegree;       ///< [rad] from level, of a supporting surface
  double coplanar_angle = 8 * base::option_text::kRadiansPerDegree;  ///< [rad] largest between pieces of one surface
  double coplanar_distance = 0.01;  ///< [m] largest between pieces of one surface, plus the sensor's distortion
  double min_height = 0.005;        ///< [m] plus the noise; points that are lower on a surface belong to the surface
  double max_gap = 0.02;            ///< [m] plus the noise; neighbours farther from each other belong to two objects
  /// [m] from a surface to the lowest visible point of an object on it, whose foot nearer objects may hide.
  double max_standing_gap = 0.3;
  int min_points = 300;    ///< least number of points of an object
  double min_size = 0.03;  ///< [m] longest side of its box
  double max_volume = 1;   ///< [m^3] of its box
  bool on_surfaces_only = true;

  static const base::OptionTable<ObjectOptions>& table();
};

/// An object as one depth image shows it. Frame: the camera's optical frame, x right, y down, z forward.
struct ObjectRegion {
  std::vector<int> pixels;                               ///< row by row, ascending
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();    ///< [m] mean of its points
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2] of the centroid, by the errors in DepthNoise
  geometry::Se3 sensor_from_box;  ///< middle and axes; z is the normal of the surface it stands on, else its least axis
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();  ///< [m] whole lengths; the box reaches down to the surface
  std::optional<int> surface;                          ///< index of the plane that it stands on
};

/// Finds the objects on tables, shelves and floors (thesis 3.4.6 and 3.5.1.2). The points of a depth image that are
/// left without its large planes form clusters; those of the right size that stand on a level surface are objects. A
/// Kinect's systematic distortion breaks a table into several planes: pieces that lie in one plane are one surface.
class ObjectFinder {
 public:
  /// Throws Error(out_of_range) for depths that are not 0 < min_depth < max_depth, for fewer than one point, and for
  /// areas, volumes or lengths that are negative or not finite.
  ObjectFinder(const ObjectOptions& options, const PlaneOptions& sensor);

  /// Returns the objects in the order of their numbers of pixels, the largest first; an image without pixels has none.
  /// `planes` are those that a PlaneSegmenter with the same PlaneOptions found in this image. `up` is a unit vector in
  /// the optical frame. Throws Error(unreadable_input) for planes of an image of another size. Thread-safe; the same
  /// input gives the same bits.
  std::vector<ObjectRegion> find(const DepthImage& image, const PlaneSegmentation& planes,
                                 const Eigen::Vector3d& up) const;
  /// Whether any of these planes is a level surface that objects may stand on.
  bool hasSurface(const PlaneSegmentation& planes, const Eigen::Vector3d& up) const;

 private:
  ObjectOptions options_;
  PlaneOptions sensor_;
};

}  // namespace omnimapper::perception

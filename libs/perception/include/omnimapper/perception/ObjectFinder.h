#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <optional>
#include <vector>

namespace omnimapper::perception {

struct ObjectOptions {
  enum class Comparator { euclidean, locally_convex };
  Comparator comparator = Comparator::locally_convex;  ///< which neighbours are of one thing
  double min_surface_area = 0.1;  ///< [m^2]; planes as large belong to the place, smaller ones to the things in it
  double max_tilt = 50 * base::option_text::kRadiansPerDegree;  ///< [rad] of a surface that things stand on, from level
  double coplanar_angle = 8 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double coplanar_distance = 0.01;  ///< [m] beside the sensor's bend; pieces of one surface differ by no more
  double min_height = 0.005;  ///< [m] beside the noise: what lies lower on a surface is taken for the surface itself
  double max_gap = 0.02;      ///< [m] beside the noise: neighbours farther from one another are of two things
  /// [m] from a surface to the lowest that is seen of a thing on it: nearer things may hide its foot.
  double max_standing_gap = 0.3;
  int min_points = 300;    ///< of a thing
  double min_size = 0.03;  ///< [m] longest side of its box
  double max_volume = 1;   ///< [m^3] of its box
  bool on_surfaces_only = true;

  static const base::OptionTable<ObjectOptions>& table();
};

/// A thing, as one depth image shows it. Frame: the camera's optical frame, x right, y down, z forward.
struct ObjectRegion {
  std::vector<int> pixels;                               ///< row by row, ascending
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();    ///< [m] mean of its points
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2] of that mean, by noise, bend and scale of the sensor
  geometry::Se3 sensor_from_box;  ///< middle and axes; z is the normal of the surface it stands on, else its least axis
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();  ///< [m] whole length along each axis; down to the surface
  std::optional<int> surface;                          ///< index of the plane that it stands on
};

/// Finds the things on tables, shelves and floors (thesis 3.4.6 and 3.5.1.2): what is left of a depth image where its
/// large planes are taken away falls into clusters of points; those of the right size that stand on a level surface
/// are things. A Kinect bends a table, so that it is found in pieces: pieces that lie in one plane are one surface.
class ObjectFinder {
 public:
  /// Throws Error(out_of_range) for depths that are not 0 < min_depth < max_depth, for fewer than one point, and for
  /// areas, volumes or lengths that are negative or not finite.
  ObjectFinder(const ObjectOptions& options, const PlaneOptions& sensor);

  /// The planes are those that a PlaneSegmenter with the same PlaneOptions found in this image. `up` is unit, in the
  /// optical frame. The one with most pixels first; none of an image without pixels. Throws
  /// Error(unreadable_input) for planes of an image of another size. Thread-safe; the same bits each time.
  std::vector<ObjectRegion> find(const DepthImage& image, const PlaneSegmentation& planes,
                                 const Eigen::Vector3d& up) const;
  /// Whether any of these planes is a level surface that things may stand on.
  bool hasSurface(const PlaneSegmentation& planes, const Eigen::Vector3d& up) const;

 private:
  ObjectOptions options_;
  PlaneOptions sensor_;
};

}  // namespace omnimapper::perception

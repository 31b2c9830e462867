#pragma once

#include <omnimapper/base/SplitMix.h>
#include <omnimapper/perception/CloudPlaneFinder.h>

#include <optional>
#include <vector>

#include "VoxelGrid.h"

namespace omnimapper::perception::clouds {

/// Points with how far they may be off a plane, in groups of neighbours. What grows with the range is along the ray, so
/// that it is off a plane by its cosine, which is the plane's distance over the range.
struct LoosePoints {
  float everywhere = 0;        ///< [m^2] square of what each may be off
  std::vector<float> x, y, z;  ///< [m]
  std::vector<float> along;    ///< square of what it may be off along its ray over its range; times distance^2: [m^2]
  std::vector<float> of;       ///< how many points it is the mean of
  std::vector<int> group;      ///< never falls from one point to the next
  std::vector<int> number;     ///< what the point was called before

  std::size_t size() const { return x.size(); }
  Eigen::Vector3d at(std::size_t i) const { return Eigen::Vector3f(x[i], y[i], z[i]).cast<double>(); }
  /// Square of what the point may be off a plane [m^2].
  float tolerance(std::size_t i, const geometry::Plane3& plane) const {
    const auto distance = static_cast<float>(plane.distance);
    return everywhere + along[i] * distance * distance;
  }
  /// Square of its distance from a plane, in parts of what it may be off.
  float off(std::size_t i, const geometry::Plane3& plane) const;
  /// Keeps those whose flag is not set.
  void remove(const std::vector<bool>& flags);
};

/// Groups means of points by cubes of `options.sample_radius`, and tells how far they may be off.
LoosePoints loosen(const Voxels& voxels, const CloudPlaneOptions& options);

/// The plane that most points are on, of those through three neighbours and after least squares; none if fewer than
/// `options.min_points` are. Normal towards the origin.
std::optional<geometry::Plane3> findPlane(const LoosePoints& points, const CloudPlaneOptions& options,
                                          base::SplitMix& random);

/// Least squares, weighted by how far points may be off a plane that is known roughly, and by how many each is the mean
/// of. Normal towards the origin.
geometry::Plane3 fitPlane(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& roughly);

}  // namespace omnimapper::perception::clouds

#pragma once

#include <omnimapper/base/SplitMix.h>
#include <omnimapper/perception/CloudPlaneFinder.h>

#include <optional>
#include <vector>

#include "VoxelGrid.h"

namespace omnimapper::perception::clouds {

/// Points with the tolerances of their distances from a plane, in groups of neighbours. The tolerance that grows with
/// the range is along the ray. Across a plane it is multiplied by the cosine of the ray's angle to the normal, which is
/// the plane's distance over the range.
struct LoosePoints {
  float everywhere = 0;        ///< [m^2] squared tolerance that all points have
  std::vector<float> x, y, z;  ///< [m]
  std::vector<float> along;    ///< squared tolerance along the ray, over the squared range [-]
  std::vector<float> of;       ///< number of points that it is the mean of
  std::vector<int> group;      ///< number of its group; ascending
  std::vector<int> number;     ///< index of its voxel

  std::size_t size() const { return x.size(); }
  Eigen::Vector3d at(std::size_t i) const { return Eigen::Vector3f(x[i], y[i], z[i]).cast<double>(); }
  /// Squared tolerance of the point's distance from a plane [m^2].
  float tolerance(std::size_t i, const geometry::Plane3& plane) const {
    const auto distance = static_cast<float>(plane.distance);
    return everywhere + along[i] * distance * distance;
  }
  /// Squared distance of the point from a plane, relative to its squared tolerance: at most 1 for inliers.
  float off(std::size_t i, const geometry::Plane3& plane) const;
  /// Removes the points whose flag is set.
  void remove(const std::vector<bool>& flags);
};

/// Groups the means of voxels by cubes of side `options.sample_cube`, and computes their tolerances.
LoosePoints loosen(const Voxels& voxels, const CloudPlaneOptions& options);

/// Draws planes through three neighbouring points and returns the one that most points are on, refined by least
/// squares; none if fewer than `options.min_points` are on it. Its normal points towards the origin.
std::optional<geometry::Plane3> findPlane(const LoosePoints& points, const CloudPlaneOptions& options,
                                          base::SplitMix& random);

/// Fits a plane by least squares. Points are weighted by the inverse of their squared tolerance, for the plane
/// `roughly`, and by the number of points that each is the mean of. The normal points towards the origin.
geometry::Plane3 fitPlane(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& roughly);

}  // namespace omnimapper::perception::clouds

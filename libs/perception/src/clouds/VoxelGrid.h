#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception::clouds {

constexpr int kNoVoxel = -1;

struct Voxels {
  std::vector<Eigen::Vector3f> means;  ///< in the order in which the voxels first occur
  std::vector<int> sizes;              ///< number of points that each is the mean of
  std::vector<int> of_point;           ///< voxel of each point; kNoVoxel if it was left out
};

/// Averages the points in cubes of side `voxel` [m], or keeps the points themselves if it is 0. Points are left out if
/// they are not finite, out of [min_range, max_range] [m] or more than 2^20 voxels away.
Voxels averaged(const std::vector<Eigen::Vector3f>& points, double voxel, double min_range, double max_range);

/// Returns the number of each point's cube of side `cell` [m], and sets `count` to the number of cubes. Cubes are
/// numbered from 0 on in the order in which they first occur. Points that are not finite or more than 2^20 cubes away
/// have kNoVoxel.
std::vector<int> cubesOf(const std::vector<Eigen::Vector3f>& points, double cell, int& count);

}  // namespace omnimapper::perception::clouds

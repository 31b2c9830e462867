#pragma once

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception::clouds {

constexpr int kNoVoxel = -1;

struct Voxels {
  std::vector<Eigen::Vector3f> means;  ///< in the order in which voxels were first met
  std::vector<int> sizes;              ///< of how many points each is the mean
  std::vector<int> of_point;           ///< for each point; kNoVoxel for what was left out
};

/// Means of the points in cubes of side `voxel` [m], or the points themselves if it is 0. Left out is what is not
/// finite, out of [min_range, max_range] [m] or more than 2^20 voxels away.
Voxels averaged(const std::vector<Eigen::Vector3f>& points, double voxel, double min_range, double max_range);

/// Numbers cubes of side `cell` [m]: for each point that of its cube, from 0 on in the order in which they are met.
/// kNoVoxel for what is not finite or more than 2^20 cubes away.
std::vector<int> cubesOf(const std::vector<Eigen::Vector3f>& points, double cell, int& count);

}  // namespace omnimapper::perception::clouds

#pragma once

#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/Normals.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace omnimapper::perception::objects {

constexpr int kPatch = 6;  ///< [px] largest width and height of a patch

/// A small connected piece of an image without sharp edges in it.
struct Patch {
  int pixels = 0;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< [m] mean of the points
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the sensor
};

/// Where two patches are neighbours: patches[a] and patches[b], a < b.
struct PatchContact {
  int a = 0, b = 0;
  int pixels = 0;  ///< number of pairs of neighbouring pixels that are near each other
};

struct ClusterPatches {
  std::vector<std::int32_t> labels;  ///< for each pixel, row by row: i + 1 if it is of patches[i], 0 if of none
  std::vector<Patch> patches;
  std::vector<PatchContact> contacts;  ///< by ascending a, then b
};

/// Cuts the clusters of `near` with at least `fewest` pixels to patches of at most kPatch by kPatch pixels. A patch
/// holds only neighbours whose normals differ by at most 30 deg. Pixels without a normal, and those so near an edge
/// that their normal is of both of its sides, belong to the patch of a neighbour; those without such a neighbour belong
/// to none.
ClusterPatches cutToPatches(const ClusterComparator& near, const NormalImage& normals, int fewest);

}  // namespace omnimapper::perception::objects

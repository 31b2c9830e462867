#pragma once

#include <omnimapper/perception/ObjectFinder.h>

#include <vector>

#include "../ConvexHull.h"

namespace omnimapper::perception::objects {

/// A level surface that things may stand on, in one piece or several.
struct Surface {
  int plane = 0;            ///< index of its largest piece
  std::vector<int> pieces;  ///< indices of planes, that one first
  Eigen::Matrix<double, 3, 2> across;
  HullNeighbourhood hull;  ///< of all pieces, along `across` [m]
};

/// The surfaces among the planes of an image, the largest piece first. The sensor bends what it sees by `bend_at_1m`
/// [m], times the squared depth.
std::vector<Surface> findSurfaces(const PlaneSegmentation& planes, const ObjectOptions& options, double bend_at_1m,
                                  const Eigen::Vector3d& up);

/// For each label, 0 included: whether its pixels belong to no thing, but to a surface or another large plane.
std::vector<std::uint8_t> labelsOfThePlace(const PlaneSegmentation& planes, const ObjectOptions& options,
                                           const std::vector<Surface>& surfaces);

}  // namespace omnimapper::perception::objects

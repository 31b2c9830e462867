#pragma once

#include <omnimapper/perception/ObjectFinder.h>

#include <vector>

#include "../ConvexHull.h"

namespace omnimapper::perception::objects {

/// A level surface that objects may stand on, in one piece or several.
struct Surface {
  int plane = 0;                       ///< index of its largest piece
  std::vector<int> pieces;             ///< indices of planes, the largest one first
  Eigen::Matrix<double, 3, 2> across;  ///< basis of the largest piece's plane
  HullNeighbourhood hull;              ///< of all pieces, along `across` [m]
};

/// Finds the surfaces among the planes of an image, in the order of their largest pieces. `distortion_at_1m` [m]: the
/// sensor's systematic distortion of a depth of 1 m, which grows with the squared depth.
std::vector<Surface> findSurfaces(const PlaneSegmentation& planes, const ObjectOptions& options,
                                  double distortion_at_1m, const Eigen::Vector3d& up);

/// For each label, 0 included: whether its pixels belong to a surface, another large plane or a piece of one, and so to
/// no object. A small plane is a piece of a large one if it lies in it, as a wall that is seen between objects does.
std::vector<std::uint8_t> labelsOfThePlace(const PlaneSegmentation& planes, const ObjectOptions& options,
                                           double distortion_at_1m, const std::vector<Surface>& surfaces);

/// The planes of the place that are no surfaces: walls, fronts of furniture.
std::vector<geometry::Plane3> uprightPlanesOfThePlace(const PlaneSegmentation& planes,
                                                      const std::vector<std::uint8_t>& of_place,
                                                      const std::vector<Surface>& surfaces);

}  // namespace omnimapper::perception::objects

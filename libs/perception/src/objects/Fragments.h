#pragma once

#include <omnimapper/geometry/Plane3.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::perception::objects {

/// How far points may be from a plane and still be of it.
struct FragmentBounds {
  double distance;        ///< [m]
  double distance_at_1m;  ///< [m] at 1 m, times the squared depth; it adds to the distance
};

/// Whether most of a cluster's points are on one of the planes: then it is a rest of a wall or of the front of a piece
/// of furniture, which is all that an image shows of it, or something as flat on it.
bool isRestOfPlane(const std::vector<Eigen::Vector3d>& cluster, const std::vector<geometry::Plane3>& planes,
                   const FragmentBounds& bounds);

/// Whether a box of these sides [m] is long and thin: longer than kLongRod and more than `max_aspect_ratio` times as
/// long as its second longest side. So are the legs of tables and chairs, rails, plinths and the edges of boards.
bool isRod(const Eigen::Vector3d& size, double max_aspect_ratio);

/// [m] Shorter things are no rods, however thin: pens, knives, bottles, which lie or stand on tables.
constexpr double kLongRod = 0.35;

}  // namespace omnimapper::perception::objects

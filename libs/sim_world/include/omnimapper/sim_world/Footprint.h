#pragma once

#include <omnimapper/sim_world/Triangulate.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Outlines on the floor are rings that go counter-clockwise. Lengths up to this value count as 0 [m].
constexpr double kFloorTolerance = 1e-6;

/// A rectangle about a centre, turned by yaw [rad]; the length is along its x axis.
Ring rectangle(const Eigen::Vector2d& centre, double length, double width, double yaw = 0);
Ring rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// The smallest rectangle along the axes that contains a ring, which must not be empty.
struct Bounds {
  Eigen::Vector2d low, high;
};
Bounds boundsOf(const Ring& ring);

/// Whether a point lies in a simple ring or on its border.
bool contains(const Ring& ring, const Eigen::Vector2d& point);
/// Distance of a point from a segment [m].
double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
/// Whether two convex rings share more than a border.
bool convexOverlap(const Ring& a, const Ring& b);
/// Whether two simple rings share more than a border.
bool overlap(const Ring& a, const Ring& b);
/// Whether a convex ring lies in a simple one; a shared border is allowed.
bool isWithin(const Ring& convex, const Ring& ring);
bool isSimple(const Ring& ring);

/// The space of something that stands on the floor: a convex outline and the heights it fills.
struct Footprint {
  std::string name;
  Ring outline_in_map;
  double low_z = 0, high_z = 0;  ///< [m]
};
bool overlap(const Footprint& a, const Footprint& b);

}  // namespace omnimapper::sim

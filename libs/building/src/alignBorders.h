#pragma once

#include <omnimapper/geometry/Se2.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::building {

/// A motion of the plane, and how well the borders of some outlines lie on those of others by it.
struct BorderAlignment {
  geometry::Se2 now_from_then;
  double score = 0;  ///< mean of both shares of border points that have one of the other map within 0.15 m; 0
                     ///< if there is no border
};

/// The score of a motion, as it is.
double scoreByBorders(const std::vector<std::vector<Eigen::Vector2d>>& then,
                      const std::vector<std::vector<Eigen::Vector2d>>& now, const geometry::Se2& motion);

/// How well outlines of rooms lie on those of another map by a motion, which is refined first by pairs of points that
/// lie close together (ICP).
BorderAlignment refinedByBorders(const std::vector<std::vector<Eigen::Vector2d>>& then,
                                 const std::vector<std::vector<Eigen::Vector2d>>& now, const geometry::Se2& motion);

/// Motions that may take some outlines to others, without any guess: the main directions of the walls are parallel or
/// at right angles, and for these four turns the shifts by which most points of borders coincide (Hough). It does not
/// need the same rooms: where walls stay, a border stays, also if rooms were split or merged.
std::vector<geometry::Se2> motionsByBorders(const std::vector<std::vector<Eigen::Vector2d>>& then,
                                            const std::vector<std::vector<Eigen::Vector2d>>& now);

}  // namespace omnimapper::building

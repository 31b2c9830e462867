#pragma once

#include <omnimapper/map/Places.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::query {

/// The point of an extent that is nearest to `point` from above: `point` itself if it lies in one of the outlines and
/// in none of its holes. None of an extent without points, lines and outlines.
std::optional<Eigen::Vector2d> nearestPoint(const map::Extent& extent, const Eigen::Vector2d& point);

/// Points of the rim of an extent, at most `step` [m] apart or, of a long rim, as many as 1000: points, lines, and what
/// goes around outlines and holes.
std::vector<Eigen::Vector2d> rimOf(const map::Extent& extent, double step);

struct NearPlace {
  const map::Place* place;
  double distance;  ///< [m] from above, to its extent; 0 inside
};

/// What is nearest to a point, the nearest first: at most `most` of what is at
/// most `within` [m] away. They point into `places`.
std::vector<NearPlace> nearestPlaces(const std::vector<map::Place>& places, const Eigen::Vector2d& point, double within,
                                     std::size_t most);

}  // namespace omnimapper::query

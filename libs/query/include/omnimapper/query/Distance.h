#pragma once

#include <omnimapper/map/Places.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::query {

/// The point of an extent that is nearest to `point`, seen from above: `point` itself if it lies in one of the outlines
/// and in none of its holes. None if the extent has no points, lines or outlines.
std::optional<Eigen::Vector2d> nearestPoint(const map::Extent& extent, const Eigen::Vector2d& point);

/// Points on the rim of an extent, that is on its points, its lines and the borders of outlines and holes: at most
/// `step` [m] apart, or about 1000 points if the rim is long.
std::vector<Eigen::Vector2d> rimOf(const map::Extent& extent, double step);

struct NearPlace {
  const map::Place* place;
  double distance;  ///< [m] seen from above, to its extent; 0 inside
};

/// The places nearest to a point, the nearest first: at most `most` of those within `within` [m]. The result points
/// into `places`.
std::vector<NearPlace> nearestPlaces(const std::vector<map::Place>& places, const Eigen::Vector2d& point, double within,
                                     std::size_t most);

}  // namespace omnimapper::query

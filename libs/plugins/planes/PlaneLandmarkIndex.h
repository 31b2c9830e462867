#pragma once

#include <omnimapper/plugin/View.h>

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "PlaneExtent.h"
#include "PlaneMeasurement.h"

namespace omnimapper::plugins {

/// The plane landmarks of a map with their extents as they are now, to find those that a measurement may be of. What it
/// keeps follows from the map, and is worked out anew where key frames have moved.
class PlaneLandmarkIndex {
 public:
  /// Whether how high a surface reaches is known: a laser's lines tell nothing of it.
  enum class Heights { unknown, known };
  /// A landmark on its plane in the map.
  struct Surface {
    base::LandmarkId id;
    base::VariableId variable;
    geometry::Plane3 plane;
    std::vector<Eigen::Vector2d> hull;                 ///< [m, PlaneAxes of the plane]
    surfaces::CellGrid seen;                           ///< cells of kSeenCell; empty of one that is too large
    surfaces::CellGrid well_seen;                      ///< of those that were seen from near and not too aslant
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m] of the hull
    double radius = 0;                                 ///< [m] of the hull about the middle
    Heights heights = Heights::unknown;
    double lowest = 0, highest = 0;  ///< [m] z in the map of what was seen of it
    base::KeyFrameId last_seen_from;
    std::size_t patches = 0;  ///< so many of the payload's are in hull and seen
    std::size_t solve = 0;    ///< number of solves when this was worked out
    std::shared_ptr<const map::LandmarkPayload> payload;
  };

  /// `owner`: INI section. `empty`: what is known of a landmark that nobody has seen yet.
  PlaneLandmarkIndex(std::string owner, const PlanePayload& empty) : owner_(std::move(owner)), empty_(empty) {}

  const landmarks::PlaneParametrization& form() const { return landmarks::PlaneParametrization::of(empty_.form); }
  const PlanePayload& emptyPayload() const { return empty_; }
  /// Throws Error(out_of_range) if the map's landmarks of that section are no surfaces of that form.
  void restore(const mapper::State& state);
  void add(base::LandmarkId id) { surfaces_[id].id = id; }
  /// Of what was retired or merged nothing is kept.
  void update(const mapper::View& view);
  const std::map<base::LandmarkId, Surface>& all() const { return surfaces_; }

 private:
  std::string owner_;
  PlanePayload empty_;
  std::map<base::LandmarkId, Surface> surfaces_;
};

/// Lowest and highest z of points [m].
std::pair<double, double> heightsOf(const std::vector<Eigen::Vector3d>& points);

/// Gap between a surface and points of another, both dropped on the plane of the first [m]; 0 where they overlap. Where
/// the surface is upright and the height of one of them is not known, the gap along the floor.
double gapBetween(const PlaneLandmarkIndex::Surface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
                  PlaneLandmarkIndex::Heights of_points);
/// A lower bound of that gap which costs little [m]; below 0 it says nothing. `middle`: the points' mean in the map.
double gapAtLeast(const PlaneLandmarkIndex::Surface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
                  const Eigen::Vector3d& middle);

}  // namespace omnimapper::plugins

#pragma once

#include <omnimapper/landmarks/LandmarkIndex.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "PlaneExtent.h"
#include "PlaneMeasurement.h"

namespace omnimapper::plugins {

/// A landmark on its plane in the map. All data are derived from the map, and computed again where key frames have
/// moved.
struct LandmarkSurface : landmarks::KnownLandmark {
  /// Whether the vertical extent of a surface is known: lines of a laser do not measure it.
  enum class Heights { unknown, known };

  geometry::Plane3 plane;
  std::vector<Eigen::Vector2d> hull;                 ///< [m] in the PlaneAxes of the plane
  surfaces::CellGrid seen;                           ///< cells of kSeenCell; empty if the surface is too large
  surfaces::CellGrid well_seen;                      ///< those cells that were seen from near and not too obliquely
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m] of the hull
  double radius = 0;                                 ///< [m] of the hull about the middle
  Heights heights = Heights::unknown;
  double lowest = 0, highest = 0;  ///< [m] z in the map of the measured parts
  base::KeyFrameId last_seen_from;
  std::size_t patches = 0;  ///< number of the payload's patches that are in hull and seen
  std::size_t solve = 0;    ///< number of solves when this was computed, plus 1
  std::shared_ptr<const map::LandmarkPayload> payload;

  void refresh(const map::Landmark& landmark, const mapper::View& view);

 private:
  void forgetExtent();
  void addPatches(const PlanePayload& payload, const map::KeyFrames& key_frames);
};

/// The plane landmarks of a map with their current extents, among which those that a measurement may be of are found.
class PlaneLandmarkIndex : public landmarks::LandmarkIndex<LandmarkSurface> {
 public:
  /// `owner`: INI section. `empty`: payload of a landmark that was not measured yet.
  PlaneLandmarkIndex(std::string owner, const PlanePayload& empty) : LandmarkIndex(std::move(owner)), empty_(empty) {}

  const plane_factors::PlaneParametrization& form() const {
    return plane_factors::PlaneParametrization::of(empty_.form);
  }
  const PlanePayload& emptyPayload() const { return empty_; }
  /// Adds the landmarks of the section. Throws Error(out_of_range) if they are not plane landmarks of the same form as
  /// emptyPayload().
  void restore(const mapper::View& view);

 private:
  PlanePayload empty_;
};

/// Lowest and highest z of points [m].
std::pair<double, double> heightsOf(const std::vector<Eigen::Vector3d>& points);

/// Gap between a surface and the points of another surface, both projected on the plane of the first one [m]; 0 if they
/// overlap. If the first surface is upright and the vertical extent of either surface is unknown, only the gap along
/// the floor counts.
double gapBetween(const LandmarkSurface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
                  LandmarkSurface::Heights of_points);
/// A cheap lower bound of gapBetween() [m]; below 0 it has no meaning. `middle`: the mean of the points in the map.
double gapAtLeast(const LandmarkSurface& surface, const std::vector<Eigen::Vector3d>& points_in_map,
                  const Eigen::Vector3d& middle);

}  // namespace omnimapper::plugins

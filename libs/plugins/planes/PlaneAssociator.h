#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/plugin/Batch.h>

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "PlaneLandmarkIndex.h"
#include "PlaneLandmarksPlugin.h"
#include "PlaneMeasurement.h"

namespace omnimapper::plugins {

/// Associates the measurements of one observation with plane landmarks, for PlaneLandmarksPlugin, and makes the batch
/// with the resulting edits.
class PlaneAssociator {
 public:
  PlaneAssociator(const PlaneLandmarksOptions& options, const mapper::PluginContext& context,
                  const PlaneLandmarkIndex& known, const map::KeyFrame& frame, const mapper::View& view,
                  bool others_seek);

  /// To be called once.
  mapper::Batch take(const std::vector<PlaneMeasurement>& measurements);

 private:
  // A landmark that this observation creates.
  struct Fresh {
    PlaneLandmarkIndex::Surface surface;
    std::shared_ptr<const PlanePayload> payload;
  };

  std::vector<mapper::Pairing> pairingsOf(const std::vector<PlaneMeasurement>& measurements);
  // Whether a match is ambiguous only because the measurement spans two landmarks on one plane, for example those on
  // both sides of a door. Either landmark is then a right choice.
  bool spansTwo(const mapper::Match& match, const std::vector<mapper::Pairing>& pairings) const;
  // How far a measurement is beyond the limits within which it may be of a surface [m], perpendicular to the surface's
  // plane or along it; <= 0 within the limits. None if the normals disagree, or if the measurement is farther away than
  // the uncertainty of the base's pose explains.
  std::optional<double> missIfAlike(const PlaneLandmarkIndex::Surface& surface, const PlaneMeasurement& measurement,
                                    const std::vector<Eigen::Vector3d>& points) const;
  // Standard deviation [m] of the position of a point at `range` [m] from the base, relative to the key frame `frame`.
  double sigmaSince(base::KeyFrameId frame, double range);
  std::vector<Eigen::Vector3d> inMap(const std::vector<Eigen::Vector3d>& in_base) const;
  graph::FactorRecord record(const PlaneMeasurement& measurement, base::VariableId plane,
                             base::LandmarkId landmark) const;
  mapper::Decision decisionOf(const PlaneMeasurement& measurement) const;
  void addToKnown(const PlaneMeasurement& measurement, const mapper::Pairing& pairing, mapper::Decision decision);
  // Whether this is the first measurement that determines the tilt of the landmark: a plane, or a line at a second
  // height (thesis 4.2.3).
  static bool determinesTilt(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
                             const PlaneLandmarkIndex::Surface& surface, const PlanePayload& payload);
  // Whether a point lies outside the surface by more than the repeatability of edges.
  static bool reachesOver(const PlaneLandmarkIndex::Surface& surface, const std::vector<Eigen::Vector3d>& points);
  News newsOf(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
              const PlaneLandmarkIndex::Surface& surface, const PlanePayload& payload) const;
  // Largest gap [m] between a surface and a measurement that may still be of the surface.
  double maxGap(const PlaneLandmarkIndex::Surface& surface, const PlaneMeasurement& measurement,
                const std::vector<Eigen::Vector3d>& points) const;
  void logUseless(const PlaneMeasurement& measurement);
  void addNew(const PlaneMeasurement& measurement, mapper::Decision decision);
  // The landmark among `fresh_` that this measurement is of, too, such as the other stretch of a wall beside a door;
  // null if there is none.
  Fresh* freshMatch(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points);

  const PlaneLandmarksOptions& options_;
  const mapper::PluginContext& context_;
  const PlaneLandmarkIndex& known_;
  const landmarks::PlaneParametrization& form_;
  const map::KeyFrame& frame_;
  const mapper::View& view_;
  // True while the pose of the newest session in the map is sought, by this plugin or by others; no measurement here
  // may then tie it to other sessions.
  const bool others_seek_;
  geometry::Se3 map_from_base_;
  double pose_sigma_ = 0;                                                  // [m] of the base in the map
  std::map<base::KeyFrameId, std::pair<double, double>> variances_since_;  // of position [m^2], of rotation [rad^2]
  std::vector<Fresh> fresh_;
  std::set<base::FactorId> removed_priors_;                                   // upright priors that were removed
  std::map<base::LandmarkId, std::shared_ptr<const PlanePayload>> payloads_;  // of those matched so far
  mapper::Batch batch_;
};

}  // namespace omnimapper::plugins

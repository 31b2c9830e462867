#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/landmarks/LandmarkAssociator.h>

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "PlaneLandmarkIndex.h"
#include "PlaneLandmarksOptions.h"
#include "PlaneMeasurement.h"

namespace omnimapper::plugins {

/// The planes or lines of one observation, for PlaneLandmarksPlugin.
class PlaneAssociator : public landmarks::LandmarkAssociator<PlaneMeasurement> {
 public:
  /// `others_seek`: the pose of the newest session in the map is sought, by this plugin or by others; no measurement
  /// may then tie it to other sessions. All references must outlive this object.
  PlaneAssociator(const PlaneLandmarksOptions& options, const std::string& section, const PlaneLandmarkIndex& known,
                  const map::KeyFrame& frame, const mapper::View& view, bool others_seek);

 protected:
  void describe(const PlaneMeasurement& measurement, mapper::Decision& decision) const override;
  std::string whyUseless(const PlaneMeasurement& measurement) const override { return measurement.why_useless; }
  std::vector<base::LandmarkId> candidates(const PlaneMeasurement& measurement) override;
  graph::FactorRecord record(const PlaneMeasurement& measurement, base::VariableId plane) const override;
  // A measurement may span two landmarks on one plane, for example those on both sides of a door.
  std::string whyEither(base::LandmarkId a, base::LandmarkId b) const override;
  std::shared_ptr<const map::LandmarkPayload> learned(const PlaneMeasurement& measurement,
                                                      const landmarks::LandmarkIds& known) override;
  void addNew(const PlaneMeasurement& measurement, mapper::Decision decision) override;

 private:
  // A run that only localizes does not update landmarks, so candidates, which may be noise, must not constrain a pose.
  bool mayConstrain(const LandmarkSurface& surface) const;
  // How far a measurement is beyond the limits within which it may be of a surface [m], perpendicular to the surface's
  // plane or along it; <= 0 within the limits. None if the normals disagree, or if the measurement is farther away than
  // the uncertainty of the base's pose explains.
  std::optional<double> missIfAlike(const LandmarkSurface& surface, const PlaneMeasurement& measurement,
                                    const std::vector<Eigen::Vector3d>& points) const;
  // Standard deviation [m] of the position of a point at `range` [m] from the base, relative to the key frame `since`.
  double sigmaSince(base::KeyFrameId since, double range);
  std::vector<Eigen::Vector3d> inMap(const std::vector<Eigen::Vector3d>& in_base) const;
  // Whether this is the first measurement that determines the tilt of the landmark: a plane, or a line at a second
  // height (thesis 4.2.3).
  static bool determinesTilt(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
                             const LandmarkSurface& surface, const PlanePayload& payload);
  // Whether a point lies outside the surface by more than the repeatability of edges.
  static bool reachesOver(const LandmarkSurface& surface, const std::vector<Eigen::Vector3d>& points);
  News newsOf(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
              const LandmarkSurface& surface, const PlanePayload& payload) const;
  // Largest gap [m] between a surface and a measurement that may still be of the surface.
  double maxGap(const LandmarkSurface& surface, const PlaneMeasurement& measurement,
                const std::vector<Eigen::Vector3d>& points) const;
  // Adds the prior that keeps a plane upright whose tilt was not measured.
  void holdUpright(const LandmarkSurface& surface);
  void addToFresh(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points,
                  LandmarkSurface& fresh);
  // The landmark among `fresh_` that this measurement is of, too, such as the other stretch of a wall beside a door;
  // null if there is none.
  LandmarkSurface* freshMatch(const PlaneMeasurement& measurement, const std::vector<Eigen::Vector3d>& points);

  const PlaneLandmarksOptions& options_;
  const PlaneLandmarkIndex& known_;
  const plane_factors::PlaneParametrization& form_;
  const bool others_seek_;
  const geometry::Se3 map_from_base_;
  double pose_sigma_ = 0;                                                  // [m] of the base in the map
  std::map<base::KeyFrameId, std::pair<double, double>> variances_since_;  // of position [m^2], of rotation [rad^2]
  std::vector<LandmarkSurface> fresh_;                                     // landmarks that this observation creates
  std::set<base::FactorId> removed_priors_;                                // upright priors that were removed
};

}  // namespace omnimapper::plugins

#pragma once

#include <omnimapper/landmarks/LandmarkPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/SessionSeeking.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "PlaneLandmarkIndex.h"
#include "PlaneLandmarksOptions.h"

namespace omnimapper::plugins {

/// Planes of walls, tables and floors as landmarks (thesis 4.2), measured by the planes of depth images and clouds
/// (CObservationPlanes) and by the lines of 2D lasers (CObservationLaserLines): a wall is one landmark for all sensors.
/// A landmark that only lines at one height have measured is held upright by a prior with upright_sigma. Coplanar
/// surfaces with a large gap between them are separate landmarks, and so are the two faces of a wall. Landmarks that
/// turn out to be one surface are merged.
///
/// A session that begins at an unknown place is searched for by its planes if no other plugin searches for it
/// (SessionByPlanes). While the session is tied to the map, its planes are compared with those of the map: that
/// confirms where it is, or contradicts it.
class PlaneLandmarksPlugin : public landmarks::LandmarkPlugin<PlaneLandmarkIndex>,
                             public mapper::LeavesSeeking,
                             public mapper::ConfirmsSession {
 public:
  static constexpr const char* kName = "PlaneLandmarksPlugin";
  static constexpr const char* kSummary =
      "Walls, tables and floors as landmarks, measured as planes and as the lines of a laser.";
  static void registerKinds(mapper::Kinds& kinds);

  PlaneLandmarksPlugin(const PlaneLandmarksOptions& options, const mapper::PluginContext& context);
  ~PlaneLandmarksPlugin() override;

  bool wants(const mrpt::obs::CObservation& observation) const override;
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;
  void leaveSeeking(bool others_seek) override { others_seek_ = others_seek; }
  Says aboutSession() const override;

 protected:
  mapper::Batch associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                          const mapper::View& view) override;
  mapper::Batch merge(const mapper::View& view) override;
  mapper::Batch finish(const mapper::View& view) override;

 private:
  // Takes the measurements for the search of the session and for the comparison with the map. The batch moves the
  // session if its place was found.
  mapper::Batch watchSession(const map::KeyFrame& frame, const std::vector<PlaneMeasurement>& measurements,
                             const Eigen::Vector3d& sensor_in_base, const mapper::View& view);
  mapper::Decision aboutSearch(const map::KeyFrame& frame, bool accepted, std::string reason) const;

  PlaneLandmarksOptions options_;
  mapper::PluginContext context_;
  std::unique_ptr<struct PlaneSession> session_;
  bool others_seek_ = false;  // other plugins seek the pose of the newest session in the map
};

}  // namespace omnimapper::plugins

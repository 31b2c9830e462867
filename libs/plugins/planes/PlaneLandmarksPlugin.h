#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/SessionSeeking.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct PlaneLandmarksOptions : mapper::AssociationOptions {
  enum class Form { plane, wall };
  Form form = Form::plane;
  /// Height of the floor, above which a level surface can be a table: that of the base at the first key frame (start),
  /// or z = 0 of the map (map).
  enum class Ground : std::uint8_t { start = 0, map = 1 };
  Ground ground = Ground::start;
  /// How the measured parts of a surface become its boundary in the map.
  enum class Boundary : std::uint8_t {
    hull = 0,  ///< their convex hull
    seen = 1   ///< their union, with bays and holes
  };
  Boundary boundary = Boundary::seen;
  bool planes = true;       ///< measure CObservationPlanes
  bool lines = true;        ///< measure CObservationLaserLines
  double min_area = 0.25;   ///< [m^2] of a plane measurement that creates a landmark
  double min_length = 0.8;  ///< [m] of a line measurement that creates a landmark
  /// [m] Largest gap between stretches of one wall, for lines and for surfaces that are higher than furniture.
  double max_gap = 0.5;
  /// [m] Largest gap between other surfaces of one landmark.
  double max_plane_gap = 0.15;
  /// Parts of a surface that are measured from farther away or more obliquely are drawn only where nothing better is
  /// known: depth noise grows with the square of the distance, and mixed pixels at edges reach far along a grazing ray.
  double well_seen_within = 4;                                         ///< [m]
  double well_seen_under = 75 * base::option_text::kRadiansPerDegree;  ///< [rad] between the ray and the normal
  double plane_sigma = 0.01;                                           ///< [m] deviation of a surface from flat
  double plane_angle_sigma = base::option_text::kRadiansPerDegree;     ///< [rad]
  double line_sigma = 0.01;                                            ///< [m]
  double line_angle_sigma = base::option_text::kRadiansPerDegree / 2;  ///< [rad]
  double upright_sigma = 5 * base::option_text::kRadiansPerDegree;     ///< [rad]
  double loss_scale = 3;                                               ///< [sigma] of the Huber loss

  static const base::OptionTable<PlaneLandmarksOptions>& table();
};

/// Planes of walls, tables and floors as landmarks (thesis 4.2), measured by the planes of depth images and clouds
/// (CObservationPlanes) and by the lines of 2D lasers (CObservationLaserLines): a wall is one landmark for all sensors.
/// A landmark that only lines at one height have measured is held upright by a prior with upright_sigma. Coplanar
/// surfaces with a large gap between them are separate landmarks, and so are the two faces of a wall. Landmarks that
/// turn out to be one surface are merged.
///
/// A session that begins at an unknown place is searched for by its planes if no other plugin searches for it
/// (SessionByPlanes). While the session is tied to the map, its planes are compared with those of the map: that
/// confirms where it is, or contradicts it.
class PlaneLandmarksPlugin : public mapper::MeasurementPlugin,
                             public mapper::LeavesSeeking,
                             public mapper::ConfirmsSession {
 public:
  PlaneLandmarksPlugin(const PlaneLandmarksOptions& options, const mapper::PluginContext& context);
  ~PlaneLandmarksPlugin() override;

  bool wants(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void applied(const mapper::AppliedBatch& ids) override;
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  mapper::Batch atEnd(const mapper::View& view) override;
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;
  void restore(const map::MapSection* saved, const mapper::View& view) override;
  void leaveSeeking(bool others_seek) override { others_seek_ = others_seek; }
  Says aboutSession() const override;

 private:
  // Takes the measurements for the search of the session and for the comparison with the map. The batch moves the
  // session if its place was found.
  mapper::Batch watchSession(const map::KeyFrame& frame, const std::vector<struct PlaneMeasurement>& measurements,
                             const Eigen::Vector3d& sensor_in_base, const mapper::View& view);
  mapper::Decision aboutSearch(const map::KeyFrame& frame, bool accepted, std::string reason) const;

  PlaneLandmarksOptions options_;
  mapper::PluginContext context_;
  std::unique_ptr<class PlaneLandmarkIndex> known_;
  std::unique_ptr<struct PlaneSession> session_;
  std::size_t merged_at_solve_ = 0;
  bool others_seek_ = false;  // other plugins seek the pose of the newest session in the map
};

class PlaneLandmarksPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(PlaneLandmarksPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "PlaneLandmarksPlugin"; }
  std::string summary() const override {
    return "Walls, tables and floors as landmarks, measured as planes and as the lines of a laser.";
  }
  const std::vector<base::OptionSpec>& options() const override { return PlaneLandmarksOptions::table().specs(); }
  void registerKinds(mapper::Kinds& kinds) const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins

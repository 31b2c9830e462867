#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/PolygonBooleans.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/PayloadRegistry.h>
#include <omnimapper/plane_factors/PlaneParametrization.h>
#include <omnimapper/surfaces/Classification.h>

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "PlaneLandmarksOptions.h"

namespace omnimapper::plugins {

/// A part of a surface as one observation measured it. Copies share the outline, because a payload is copied at each
/// measurement.
class SurfacePatch {
 public:
  SurfacePatch(base::KeyFrameId frame_id, std::vector<Eigen::Vector3d> outline_in_base,
               std::vector<std::vector<Eigen::Vector3d>> holes_in_base = {}, bool seen_well = true)
      : frame(frame_id),
        is_well_seen(seen_well),
        in_base_(std::make_shared<surfaces::FlatPart>(
            surfaces::FlatPart{std::move(outline_in_base), std::move(holes_in_base)})) {}

  base::KeyFrameId frame;
  bool is_well_seen;  ///< from near and not too obliquely
  /// [m] A polygon with its holes (holesInBase()), or the two ends of a laser line.
  const std::vector<Eigen::Vector3d>& outlineInBase() const { return in_base_->outline; }
  const std::vector<std::vector<Eigen::Vector3d>>& holesInBase() const { return in_base_->holes; }

 private:
  std::shared_ptr<const surfaces::FlatPart> in_base_;
};

/// How often a sensor measured a surface.
struct SensorCounts {
  std::uint32_t planes = 0;  ///< as planes
  std::uint32_t lines = 0;   ///< as lines of a laser
};

/// Whether a measurement adds to the known extent of a surface.
struct News {
  bool of_extent = false;     ///< if all parts of the measurement count
  bool of_well_seen = false;  ///< if only its well seen parts count
};

/// Scatter of the measured points about their planes, as a multiple of the sensor's noise.
struct Roughness {
  double sum = 0;
  std::uint32_t count = 0;  ///< number of measurements that reported a roughness
  double mean() const { return count == 0 ? 0 : sum / count; }
};

/// Parts of a line by the distances of their ends from its begin [m], in order.
using Stretches = std::vector<std::pair<double, double>>;

/// A cache of the area that the patches of a payload cover together. If a copy of the payload gets more patches,
/// `frames` shows that the copied entry no longer holds.
class CoveredMemo {
 public:
  struct Entry {
    Eigen::VectorXd value;              ///< value of the variable of the plane
    std::vector<geometry::Se3> frames;  ///< map_from_base of the key frame of each patch
    geometry::Areas2 areas;
  };
  CoveredMemo() = default;
  CoveredMemo(const CoveredMemo& other) : entry_(other.get()) {}
  CoveredMemo& operator=(const CoveredMemo& other) {
    set(other.get());
    return *this;
  }
  std::shared_ptr<const Entry> get() const { return std::atomic_load(&entry_); }
  void set(std::shared_ptr<const Entry> entry) { std::atomic_store(&entry_, std::move(entry)); }

 private:
  std::shared_ptr<const Entry> entry_;
};

/// What is known of a plane landmark beside its plane (thesis 4.2.2.1). Its patches are attached to the key frames that
/// measured them and are projected on the optimized plane on request, so that a loop closure moves the patches at no
/// cost.
struct PlanePayload : map::LandmarkPayload {
  using Ground = PlaneLandmarksOptions::Ground;
  using Boundary = PlaneLandmarksOptions::Boundary;

  plane_factors::PlaneParametrization::Kind form = plane_factors::PlaneParametrization::Kind::plane;
  Ground ground = Ground::start;  ///< height of the floor, on which the class depends
  Boundary boundary = Boundary::hull;
  std::vector<SurfacePatch> patches;            ///< each adds to the extent of the others
  std::map<std::string, SensorCounts> seen_by;  ///< by sensor label
  Roughness roughness;
  base::KeyFrameId last_seen_from;
  /// The class of the surface in the whole map, which is determined at the end of a run; none before.
  std::optional<surfaces::Judgement> judgement;
  bool is_candidate = false;  ///< measured too rarely or too roughly to be drawn
  /// Of a surface that only laser lines measured: the stretches of its hull along which something stands, by their
  /// distances from its lower end along the first of the PlaneAxes [m], which is determined at the end of a run. None:
  /// all of it.
  std::optional<Stretches> stretches;

  std::string_view kind() const override { return "plane"; }
  void write(std::ostream& out) const override;
  bool fits(const std::vector<std::string_view>& kinds) const override;
  std::vector<base::KeyFrameId> keyFrames() const override;
  std::shared_ptr<const map::LandmarkPayload> seenFrom(const std::set<base::KeyFrameId>& frames) const override;
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);

  bool wasSeenAsPlane() const;
  /// How often the surface was measured, by all sensors, as plane or line.
  std::uint32_t measurements() const;
  /// z of the floor that people walk on, in the map [m].
  double groundIn(const map::KeyFrames& key_frames) const;
  /// How often the surface was measured as a plane.
  std::uint32_t planeMeasurements() const;
  /// A copy with one more measurement. The measured outline is added only if `news` says that it adds to the extent.
  std::shared_ptr<const PlanePayload> with(base::KeyFrameId frame, const struct PlaneMeasurement& measurement,
                                           const News& news) const;
  /// A copy that is merged with another payload.
  std::shared_ptr<const PlanePayload> with(const PlanePayload& other) const;

  /// Whether the surface was found good enough to be drawn at the end of a run. It stays accepted from then on, because
  /// growth of the map elsewhere is no argument against it.
  bool isAccepted() const { return judgement && !is_candidate; }

 private:
  // After a new measurement, a surface that is not accepted is drawn until the next end of a run judges it again.
  void resetJudgement();
  // The area that is drawn, in the PlaneAxes of the plane that has this value [m].
  geometry::Areas2 coveredOn(const Eigen::VectorXd& value, const map::KeyFrames& key_frames) const;

  mutable CoveredMemo memo_;
};

/// The surfaces of a shape, each with its holes.
std::vector<surfaces::FlatPart> partsOf(const map::LandmarkShape& shape);

}  // namespace omnimapper::plugins

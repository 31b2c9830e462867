#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/PolygonBooleans.h>
#include <omnimapper/landmarks/PlaneParametrization.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/PayloadRegistry.h>
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

#include "PlaneLandmarksPlugin.h"

namespace omnimapper::plugins {

/// A part of a surface as one observation showed it. Copies share the outline, for a payload is copied at each
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
  bool is_well_seen;  ///< from near and not too aslant
  /// [m] a polygon, or the two ends of a laser line; and the holes in it.
  const std::vector<Eigen::Vector3d>& outlineInBase() const { return in_base_->outline; }
  const std::vector<std::vector<Eigen::Vector3d>>& holesInBase() const { return in_base_->holes; }

 private:
  std::shared_ptr<const surfaces::FlatPart> in_base_;
};

/// Which sensor saw it, and how often.
struct SeenBy {
  std::uint32_t planes = 0;  ///< as planes
  std::uint32_t lines = 0;   ///< as lines of a laser
};

/// What a measurement tells of a surface's extent that is not known yet.
struct News {
  bool of_extent = false;     ///< by all of it
  bool of_well_seen = false;  ///< by what it shows from near
};

/// By how many times more than the sensor's noise the points of measurements scattered about their planes.
struct Roughness {
  double sum = 0;
  std::uint32_t count = 0;  ///< of the measurements that told
  double mean() const { return count == 0 ? 0 : sum / count; }
};

/// What patches cover together, as it was worked out last. A copy may be asked by a payload with more patches, which
/// does not find them in `frames`.
class CoveredMemo {
 public:
  struct Entry {
    Eigen::VectorXd value;              ///< of the plane
    std::vector<geometry::Se3> frames;  ///< map_from_base of the patches
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

/// What is known of a plane landmark beside where its plane is (thesis 4.2.2.1). Its parts hang on the key frames that
/// saw them and are put on the optimised plane when somebody asks, so that a loop closure moves them for free.
struct PlanePayload : map::LandmarkPayload {
  using Ground = PlaneLandmarksOptions::Ground;
  using Boundary = PlaneLandmarksOptions::Boundary;

  landmarks::PlaneParametrization::Kind form = landmarks::PlaneParametrization::Kind::plane;
  Ground ground = Ground::start;  ///< for what people call it
  Boundary boundary = Boundary::hull;
  std::vector<SurfacePatch> patches;      ///< those that tell something of the extent that the others do not
  std::map<std::string, SeenBy> seen_by;  ///< sensor label
  Roughness roughness;
  base::KeyFrameId last_seen_from;
  /// What it is in the whole map, as the end of a run found it; none before.
  std::optional<surfaces::Judgement> judgement;
  bool is_candidate = false;  ///< seen too little to be drawn

  std::string_view kind() const override { return "plane"; }
  void write(std::ostream& out) const override;
  bool fits(const std::vector<std::string_view>& kinds) const override;
  std::vector<base::KeyFrameId> keyFrames() const override;
  std::shared_ptr<const map::LandmarkPayload> seenFrom(const std::set<base::KeyFrameId>& frames) const override;
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);

  bool wasSeenAsPlane() const;
  /// How often it was seen, by all sensors, as plane or line.
  std::uint32_t measurements() const;
  /// z of where people walk, in the map [m].
  double groundIn(const map::KeyFrames& key_frames) const;
  /// How often it was seen as a plane.
  std::uint32_t planeMeasurements() const;
  /// With one more measurement; its outline only where that is news.
  std::shared_ptr<const PlanePayload> with(base::KeyFrameId frame, const struct PlaneMeasurement& measurement,
                                           const News& news) const;
  /// With all that is known of another.
  std::shared_ptr<const PlanePayload> with(const PlanePayload& other) const;

  /// An end of a run has found it good enough to be drawn. It stays so: that a map grows elsewhere says nothing of it.
  bool isAccepted() const { return judgement && !is_candidate; }

 private:
  // What was seen once more is judged anew at the next end, and drawn until then.
  void forgetSearchUncertainty();
  // What is drawn of it [m, PlaneAxes of the plane of that value].
  geometry::Areas2 coveredOn(const Eigen::VectorXd& value, const map::KeyFrames& key_frames) const;

  mutable CoveredMemo memo_;
};

/// The surfaces of a shape, each with its holes.
std::vector<surfaces::FlatPart> partsOf(const map::LandmarkShape& shape);

}  // namespace omnimapper::plugins

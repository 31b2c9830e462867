#pragma once

#include <omnimapper/geometry/Plane3.h>
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
#include <vector>

#include "PlaneLandmarksPlugin.h"

namespace omnimapper::plugins {

/// A part of a surface as one observation showed it.
struct SurfacePatch {
  base::KeyFrameId frame;
  std::vector<Eigen::Vector3d> outline_in_base;               ///< [m] a polygon, or the two ends of a laser line
  std::vector<std::vector<Eigen::Vector3d>> holes_in_base{};  ///< [m] in the polygon
  bool is_well_seen = true;                                   ///< from near and not too aslant
};

/// Which sensor saw it, and how often.
struct SeenBy {
  std::uint32_t planes = 0;  ///< as planes
  std::uint32_t lines = 0;   ///< as lines of a laser
};

/// What a sighting tells of a surface's extent that is not known yet.
struct News {
  bool of_extent = false;     ///< by all of it
  bool of_well_seen = false;  ///< by what it shows from near
};

/// By how many times more than the sensor's noise the points of sightings scattered about their planes.
struct Roughness {
  double sum = 0;
  std::uint32_t count = 0;  ///< of the sightings that told
  double mean() const { return count == 0 ? 0 : sum / count; }
};

/// A shape as it was worked out last. A copy begins without, for it may be of another payload.
class ShapeMemo {
 public:
  struct Entry {
    std::vector<Eigen::VectorXd> values;
    std::vector<geometry::Se3> frames;  ///< map_from_base of the patches
    map::LandmarkShape shape;
  };
  ShapeMemo() = default;
  ShapeMemo(const ShapeMemo&) {}
  ShapeMemo& operator=(const ShapeMemo&) { return *this; }
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
  std::uint32_t sightings() const;
  /// z of where people walk, in the map [m].
  double groundIn(const map::KeyFrames& key_frames) const;
  /// How often it was seen as a plane.
  std::uint32_t planeSightings() const;
  /// With one more sighting; its outline only where that is news.
  std::shared_ptr<const PlanePayload> with(base::KeyFrameId frame, const struct PlaneMeasurement& sighting,
                                           const News& news) const;
  /// With all that is known of another.
  std::shared_ptr<const PlanePayload> with(const PlanePayload& other) const;

  /// An end of a run has found it good enough to be drawn. It stays so: that a map grows elsewhere says nothing of it.
  bool isAccepted() const { return judgement && !is_candidate; }

 private:
  // What was seen once more is judged anew at the next end, and drawn until then.
  void forgetDoubt();
  map::LandmarkShape shapeNow(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const;

  mutable ShapeMemo memo_;
};

/// The surfaces of a shape, each with its holes.
std::vector<surfaces::FlatPart> partsOf(const map::LandmarkShape& shape);

}  // namespace omnimapper::plugins

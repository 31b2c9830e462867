#pragma once

#include <gtest/gtest.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planes/PlaneLandmarksPlugin.h"

namespace omnimapper::plugins::surface_run {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Plane3;
using mrpt::poses::CPose3D;

/// A rectangle around `middle` with half-axes a and b; the normal is a x b.
inline obs::ObservedPlane plane(const Vector3d& middle, const Vector3d& a, const Vector3d& b) {
  obs::ObservedPlane seen;
  seen.plane_in_sensor = Plane3::through(middle, a.cross(b).normalized());
  seen.covariance = Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  seen.centroid = middle;
  seen.outline.vertices = {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
  seen.inliers = 1000;
  return seen;
}

/// A wall on x = `x`, facing the origin, from y0 to y1 and as high as the view of a camera.
inline obs::ObservedPlane wallPlane(double x, double y0, double y1) {
  return plane({x, 0.5 * (y0 + y1), 1}, {0, -0.5 * (y1 - y0), 0}, {0, 0, 0.8});
}

/// A table top at that height.
inline obs::ObservedPlane tableTop(double x, double y, double z) {
  return plane({x, y, z}, {0.4, 0, 0}, {0, 0.3, 0});
}

inline obs::LaserLine line(const Vector2d& from, const Vector2d& to) {
  obs::LaserLine seen;
  seen.segment_in_sensor = {from, to};
  const Vector2d along = (to - from).normalized();
  Vector2d out(along.y(), -along.x());  // from the sensor to the wall
  if (out.dot(from) < 0) out = -out;
  seen.angle = std::atan2(out.y(), out.x());
  seen.distance = out.dot(from);
  seen.covariance = Vector2d(1e-5, 1e-4).asDiagonal();
  return seen;
}

template <class Observation>
Observation stamped(Observation observation, const std::string& source, double z) {
  observation.source_label = source;
  observation.sensorLabel = source + ".derived";
  observation.sensorPose = CPose3D(0, 0, z, 0, 0, 0);
  return observation;
}

inline obs::CObservationPlanes planesOf(std::vector<obs::ObservedPlane> planes, double z = 0) {
  obs::CObservationPlanes observation;
  observation.planes = std::move(planes);
  return stamped(observation, "camera", z);
}

inline obs::CObservationLaserLines linesOf(std::vector<obs::LaserLine> lines, double z = 0.4) {
  obs::CObservationLaserLines observation;
  observation.lines = std::move(lines);
  return stamped(observation, "laser", z);
}

/// A map to which observations of surfaces are added by hand, one after the other.
class SurfaceRun : public ::testing::Test {
 protected:
  explicit SurfaceRun(PlaneLandmarksOptions options = {}) { make(options); }

  void make(const PlaneLandmarksOptions& options) {
    mapper::PluginContext context;
    context.section = "planes";
    context.motion = run_.motion;
    plugin_ = std::make_unique<PlaneLandmarksPlugin>(options, context);
  }
  void driveTo(const CPose3D& map_from_base) {
    const bool is_first = run_.map.key_frames.empty();
    const map::KeyFrame before = is_first ? map::KeyFrame() : run_.map.key_frames.back();
    const map::KeyFrame& frame = run_.addFrame(map_from_base);
    if (!is_first) {
      link(before, frame, 1e-4);
    }
    run_.uncertainty = mapper::Uncertainty(run_.graph);
  }
  // The motion between two key frames, as odometry measures it; `variance` in each direction [m^2] [rad^2].
  void link(const map::KeyFrame& before, const map::KeyFrame& frame, double variance) {
    mrpt::math::CMatrixDouble66 covariance;
    covariance.setDiagonal(6, variance);
    run_.graph.addFactor(mapper::betweenPoses(run_.motion, before.pose, frame.pose,
                                              {frame.map_from_base - before.map_from_base, covariance.asEigen()},
                                              "odometry"));
  }
  void apply(const mapper::Batch& batch) {
    const auto ids = mapper::apply(batch, {"planes", run_.map.key_frames.back().stamp}, run_.graph, run_.map);
    run_.decisions.insert(run_.decisions.end(), batch.decisions().begin(), batch.decisions().end());
    plugin_->applied(ids);
  }
  void see(const mrpt::obs::CObservation& observation) {
    ASSERT_TRUE(plugin_->wants(observation));
    apply(plugin_->measure(run_.map.key_frames.back(), {observation, nullptr}, run_.view()));
  }
  // Solves as the engine does, and runs what plugins do after it.
  void solve() {
    graph::solve(run_.graph);
    for (std::size_t i = 0; i < run_.map.key_frames.size(); ++i) {
      auto& frame = run_.map.key_frames.edit(run_.map.key_frames[i].id);
      frame.map_from_base = mapper::poseOf(run_.graph, frame.pose);
    }
    commit();
  }
  void commit() {
    run_.uncertainty = mapper::Uncertainty(run_.graph);
    run_.solves.emplace_back();
    apply(plugin_->afterCommit(run_.map.key_frames.back(), run_.view()).batch);
  }
  std::vector<map::Landmark> active() const {
    std::vector<map::Landmark> found;
    for (const auto& [id, landmark] : run_.map.landmarks)
      if (landmark.state == map::Landmark::State::active) found.push_back(landmark);
    return found;
  }
  map::LandmarkShape shapeOf(const map::Landmark& landmark) const {
    return landmark.payload->shape({run_.graph.value(landmark.variables.front())}, run_.map.key_frames);
  }
  std::size_t factorsOfKind(const std::string& kind) const {
    std::size_t count = 0;
    for (const auto& [id, record] : run_.graph.factors()) count += record.factor->kind() == kind;
    return count;
  }

  testing::HandMadeRun run_;
  std::unique_ptr<PlaneLandmarksPlugin> plugin_;
};

}  // namespace omnimapper::plugins::surface_run

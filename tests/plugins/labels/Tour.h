#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <memory>
#include <string>
#include <utility>

#include "labels/LabelsPlugin.h"

namespace omnimapper::plugins::labels_test {

using Eigen::Vector3d;
using mrpt::obs::CObservationSkeleton;

struct FixedShape : map::LandmarkPayload {
  explicit FixedShape(map::LandmarkShape its) : kept(std::move(its)) {}
  std::string_view kind() const override { return "test"; }
  void write(std::ostream&) const override {}
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>&, const map::KeyFrames&) const override { return kept; }
  map::LandmarkShape kept;
};

inline map::LandmarkShape surface(const std::string& label, std::vector<Vector3d> corners) {
  map::LandmarkShape shape;
  shape.label = label;
  shape.surfaces = {{std::move(corners)}};
  return shape;
}

inline map::LandmarkShape boxed(const std::string& label, const Vector3d& middle, const Vector3d& size) {
  map::LandmarkShape shape;
  shape.label = label;
  shape.box = map::Box{middle, Eigen::Quaterniond::Identity(), size};
  return shape;
}

/// A robot that stands at the origin of a room with a table, two walls and two cups, and people who point.
class Tour {
 public:
  explicit Tour(const LabelsOptions& options = {}) : plugin(options, {}, {}, {}, context()) {
    run.addFrame({});
    table = add(surface("table", {{0.5, -2.2, 0.7}, {1.9, -2.2, 0.7}, {1.9, -1.2, 0.7}, {0.5, -1.2, 0.7}}));
    left_wall = add(surface("wall", {{-1, 3, 0}, {5, 3, 0}, {5, 3, 2.5}, {-1, 3, 2.5}}));
    back_wall = add(surface("wall", {{5, -3, 0}, {5, 3, 0}, {5, 3, 2.5}, {5, -3, 2.5}}));
    cup = add(boxed("cup", {0.8, -1.5, 0.75}, {0.08, 0.08, 0.1}));
    near_cup = add(boxed("cup", {0.86, -1.5, 0.75}, {0.08, 0.08, 0.1}));
    far_cup = add(boxed("cup", {1.8, 1.6, 1.0}, {0.08, 0.08, 0.1}));
  }

  base::LandmarkId add(map::LandmarkShape shape) {
    map::Landmark landmark;
    landmark.id = run.map.landmarks.nextId(0);
    landmark.kind = "thing";
    landmark.payload = std::make_shared<FixedShape>(std::move(shape));
    landmark.evidence = 10;
    return run.map.landmarks.add(0, landmark);
  }

  void command(const std::string& text, obs::CommandSubject subject = obs::CommandSubject::any, double expiry = 0,
               obs::CommandKind kind = obs::CommandKind::label) {
    obs::CObservationCommand command;
    command.kind = kind;
    command.text = text;
    command.subject = subject;
    command.expiry = expiry;
    command.origin = "anna";
    show(command);
  }
  void edit(const std::string& text) { command(text, obs::CommandSubject::any, 0, obs::CommandKind::edit); }

  /// For a second a person points at this with its right arm, and misses it as people do on average.
  void point(const Vector3d& target, const Vector3d& hand = {1.8, -0.3, 1.2}, double seconds = 1) {
    for (int k = 0; k < 10 * seconds; ++k) show(skeleton(target, hand));
    wait(1.5);  // the arm is lowered
  }
  void wait(double seconds) { time_ += seconds; }

  static CObservationSkeleton skeleton(const Vector3d& target, const Vector3d& hand) {
    const auto errors = interaction::errorsTowards(interaction::thesisModel(interaction::SkeletonSoftware::openni), {});
    const auto from = [&](const interaction::RayErrors& ray, double length) -> Vector3d {
      return hand - length * interaction::directionWithError(hand, target, {ray.theta.mean, ray.psi.mean});
    };
    CObservationSkeleton s;
    const auto put = [](CObservationSkeleton::TSkeletonJoint& joint, const Vector3d& p) {
      joint.x = p.x(), joint.y = p.y(), joint.z = p.z(), joint.conf = 1;
    };
    put(s.right_hand, hand);
    put(s.right_elbow, from(errors.elbow_hand, 0.3));
    put(s.head, from(errors.head_hand, 0.6));
    const Vector3d head(s.head.x, s.head.y, s.head.z);
    put(s.torso, head - Vector3d(0, 0, 0.5));
    put(s.left_shoulder, head + Vector3d(0, -0.2, -0.2));
    put(s.right_shoulder, head + Vector3d(0, 0.2, -0.2));
    return s;
  }

  template <class Observation>
  void show(Observation observation) {
    observation.timestamp = base::stampFromUnix(1.6e9 + time_);
    observation.sensorLabel = "test";
    time_ += 0.1;
    ASSERT_TRUE(plugin.watches(observation));
    const auto& frame = run.map.key_frames.back();
    const mapper::Watched watched{observation, mapper::WatchedPose{frame.id, {}, frame.map_from_base}};
    apply(plugin.watch(watched, run.view()).batch);
  }
  void end() { apply(plugin.atEnd(run.view())); }

  map::Labels labels() const {
    const auto* layer = run.map.layers.find<map::Labels>();
    return layer ? *layer : map::Labels();
  }
  std::string lastReason() const { return reasons.empty() ? "" : reasons.back(); }

  testing::HandMadeRun run;
  base::LandmarkId table, left_wall, back_wall, cup, near_cup, far_cup;
  LabelsPlugin plugin;
  std::vector<std::string> reasons;

 private:
  static mapper::PluginContext context() {
    mapper::PluginContext context;
    context.section = "labels";
    return context;
  }
  void apply(const mapper::Batch& batch) {
    for (const auto& [name, layer] : batch.layers())
      layer ? run.map.layers.set(name, layer) : run.map.layers.remove(name);
    for (const auto& decision : batch.decisions()) reasons.push_back(decision.reason);
  }
  double time_ = 0;
};

}  // namespace omnimapper::plugins::labels_test

#pragma once

#include <omnimapper/geometry/Se2.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/plane_factors/PlaneFactors.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/plane_factors/WallVariable.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <random>

#include "dynamic/DynamicLandmarksPlugin.h"
#include "dynamic/MovedThingPayload.h"
#include "planes/PlanePayload.h"
#include "points/PointPayload.h"

namespace omnimapper::plugins {

/// Two rounds of 20 poses in a room of 6 x 7 m, past surfaces and points with the noise of a laser and a camera.
/// Landmarks move between the rounds. The map's frame is that of the first pose, which is the truth's.
class MoveableRoom {
 public:
  static constexpr std::uint32_t kRound = 20;
  enum class MeasuredAs { as_lines, as_planes, never };

  /// `two_sessions`: each round is a session, and no odometry connects them.
  explicit MoveableRoom(unsigned seed = 1, bool two_sessions = false) : random_(seed) {
    const Eigen::Vector3d sigmas(0.01, 0.01, 0.005);
    mrpt::math::CMatrixDouble66 covariance;
    covariance.setDiagonal(6, 1e-4);
    covariance(3, 3) = 2.5e-5;
    geometry::Se2 believed;
    for (std::size_t i = 0; i < 2 * kRound; ++i) {
      const double angle = 2 * geometry::kPi * static_cast<double>(i) / kRound;
      truth_.push_back({1.2 * std::sin(angle), 1.2 * (1 - std::cos(angle)), angle});
      geometry::Se2 step;
      if (i > 0) {
        step = plus(inverse(truth_[i - 1]) * truth_[i], {noise(sigmas[0]), noise(sigmas[1]), noise(sigmas[2])});
        believed = believed * step;
      }
      const auto before = run.map.key_frames.size() > 0 ? run.map.key_frames.back().pose : base::VariableId();
      const bool is_second = two_sessions && i >= kRound;
      const auto& frame = addFrame(believed, is_second ? 1 : 0);
      if (i == 0 || (is_second && i == kRound)) continue;
      run.graph.addFactor(mapper::betweenPoses(
          run.motion, before, frame.pose, {{step.x, step.y, 0, step.yaw, 0, 0}, covariance.asEigen()}, "odometry"));
    }
  }

  /// A surface over a segment of the floor, with its free side on the left, which is at `first` in the first round and
  /// at `second` in the other.
  base::LandmarkId addSurface(plane_factors::PlaneParametrization::Kind form, const geometry::Segment2& first,
                              const geometry::Segment2& second, MeasuredAs in_first = MeasuredAs::as_lines,
                              MeasuredAs in_second = MeasuredAs::as_lines) {
    const auto planeOf = [](const geometry::Segment2& wall) {
      const Eigen::Vector2d normal = plane_factors::normalOf(wall);
      return geometry::Plane3::through({wall.from.x(), wall.from.y(), 0}, {normal.x(), normal.y(), 0});
    };
    const auto& its = plane_factors::PlaneParametrization::of(form);
    auto payload = std::make_shared<PlanePayload>();
    payload->form = form;
    const auto id = addLandmark(
        "plane", "walls", its.variable(),
        its.value(planeOf(first), {{first.from.x(), first.from.y(), 0}, {first.to.x(), first.to.y(), 0}}), payload);
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const MeasuredAs seen = i < kRound ? in_first : in_second;
      if (seen == MeasuredAs::never) continue;
      const geometry::Segment2& there = i < kRound ? first : second;
      const geometry::Se2 base_from_map = inverse(truth_[i]);
      if (i % kRound == 0) payload->patches.push_back({frame(i).id, {inBase(i, there.from), inBase(i, there.to)}});
      if (seen == MeasuredAs::as_planes) {
        const geometry::Se3 lifted{Eigen::Quaterniond(Eigen::AngleAxisd(base_from_map.yaw, Eigen::Vector3d::UnitZ())),
                                   {base_from_map.x, base_from_map.y, 0}};
        const geometry::Plane3 plane = geometry::plus(lifted * planeOf(there), {noise(0.01), noise(0.01), noise(0.02)});
        addMeasurement(i, id, std::make_shared<plane_factors::PlaneFactor>(plane), Eigen::Vector3d(0.01, 0.01, 0.02));
        ++payload->seen_by["camera"].planes;
      } else {
        const Eigen::Vector2d along = Eigen::Rotation2Dd(base_from_map.yaw + noise(0.01)) * direction(there);
        const Eigen::Vector3d at = inBase(i, middle(there) + noise(0.02) * plane_factors::normalOf(there));
        const Eigen::Vector3d along_in_space(along.x(), along.y(), 0);
        addMeasurement(i, id, its.ofLine(along_in_space, at), Eigen::Vector2d(0.01, 0.02));
        ++payload->seen_by["laser"].lines;
      }
    }
    if (its.mayTilt() && in_first != MeasuredAs::as_planes && in_second != MeasuredAs::as_planes)
      run.graph.addFactor({{variableOf(id)},
                           std::make_shared<plane_factors::UprightFactor>(),
                           graph::SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(1, 0.02))});
    return id;
  }

  /// A point that is seen at these places [m], by the number of the pose.
  base::LandmarkId addPoint(const std::map<std::size_t, Eigen::Vector2d>& places) {
    auto payload = std::make_shared<PointPayload>();
    payload->number = static_cast<std::int32_t>(run.map.landmarks.size());
    const auto id = addLandmark("point", "points", graph::point2(), places.begin()->second, payload);
    for (const auto& [pose, place] : places) {
      const Eigen::Vector2d seen = inBase(pose, place).head<2>() + Eigen::Vector2d(noise(0.03), noise(0.03));
      addMeasurement(pose, id, std::make_shared<graph::PointFactor2>(seen), Eigen::Vector2d(0.03, 0.03));
    }
    return id;
  }
  base::LandmarkId addPoint(const Eigen::Vector2d& first, const Eigen::Vector2d& second) {
    std::map<std::size_t, Eigen::Vector2d> places;
    for (std::size_t i = 0; i < truth_.size(); ++i) places[i] = i < kRound ? first : second;
    return addPoint(places);
  }

  /// A relation that the consistency test has accepted.
  void relate(base::LandmarkId a, base::LandmarkId b, std::shared_ptr<const graph::Factor> factor) {
    const Eigen::VectorXd sigmas = Eigen::VectorXd::Constant(factor->residualSize(), 0.01);
    graph::FactorRecord record{
        {variableOf(a), variableOf(b)}, std::move(factor), graph::SquareRootInformation::fromSigmas(sigmas)};
    record.tags.hypothesis = true;
    record.tags.owner = "relations";
    record.tags.landmark = a;
    run.graph.addFactor(record);
  }

  void solve() {
    graph::solve(run.graph);
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      auto& edited = run.map.key_frames.edit(run.map.key_frames[i].id);
      edited.map_from_base = mapper::poseOf(run.graph, edited.pose);
    }
    run.uncertainty = mapper::Uncertainty(run.graph);
  }

  /// Solves, runs the plugin, and solves again.
  void look(const DynamicLandmarksOptions& options = {}) {
    solve();
    mapper::PluginContext context;
    context.section = "moveables";
    DynamicLandmarksPlugin plugin(options, context);
    const auto batch = plugin.atEnd(run.view());
    mapper::apply(batch, {"moveables", run.map.key_frames.back().stamp}, run.graph, run.map);
    run.decisions.insert(run.decisions.end(), batch.decisions().begin(), batch.decisions().end());
    solve();
  }

  base::VariableId variableOf(base::LandmarkId id) const { return run.map.landmark(id).variables.front(); }
  map::Landmark::State stateOf(base::LandmarkId id) const { return run.map.landmark(id).state; }
  const MovedThingPayload* recordOf(base::LandmarkId id) const {
    for (const auto& [record, landmark] : run.map.landmarks) {
      const auto* payload = dynamic_cast<const MovedThingPayload*>(landmark.payload.get());
      if (payload && payload->landmark == id) return payload;
    }
    return nullptr;
  }
  bool isKnown(base::VariableId id) const {
    const auto covariance = run.uncertainty.joint(run.graph, {id});
    return covariance && covariance->diagonal().maxCoeff() < 1;
  }
  /// Whether a factor of positive weight binds the landmark.
  bool actsOnAnything(base::LandmarkId id) const {
    const auto factors = run.view().factorsOf(id);
    return std::any_of(factors.begin(), factors.end(),
                       [&](auto factor) { return run.graph.factor(factor).weight > 0; });
  }
  /// Error of the last pose [m].
  double error() const {
    const auto& pose = run.map.key_frames.back().map_from_base;
    return std::hypot(pose.x() - truth_.back().x, pose.y() - truth_.back().y);
  }

  testing::HandMadeRun run;

 private:
  const map::KeyFrame& addFrame(const geometry::Se2& believed, std::uint16_t session) {
    const mrpt::poses::CPose3D map_from_base(believed.x, believed.y, 0, believed.yaw, 0, 0);
    if (session == 0) return run.addFrame(map_from_base);
    const auto index = static_cast<std::uint32_t>(run.map.key_frames.size());
    map::KeyFrame frame;
    frame.id = {session, index - kRound};
    frame.stamp = base::stampFromUnix(2'000'000'000 + index);
    frame.map_from_base = map_from_base;
    frame.pose = run.graph.addVariable(mapper::poseVariable(run.motion), mapper::poseValue(run.motion, map_from_base));
    return run.map.key_frames[run.map.key_frames.insert(frame)];
  }
  double noise(double sigma) { return sigma * std::normal_distribution<double>()(random_); }
  const map::KeyFrame& frame(std::size_t i) const { return run.map.key_frames[i]; }
  /// At the height of the laser.
  Eigen::Vector3d inBase(std::size_t i, const Eigen::Vector2d& point) const {
    const Eigen::Vector2d at = inverse(truth_[i]) * point;
    return {at.x(), at.y(), 0.4};
  }

  base::LandmarkId addLandmark(const std::string& kind, const std::string& owner,
                               const std::shared_ptr<const graph::Variable>& variable, const Eigen::VectorXd& value,
                               std::shared_ptr<const map::LandmarkPayload> payload) {
    map::Landmark landmark;
    landmark.id = run.map.landmarks.nextId(0);
    landmark.kind = kind;
    landmark.owner = owner;
    landmark.variables = {run.graph.addVariable(variable, value)};
    landmark.payload = std::move(payload);
    landmark.evidence = 10;
    const auto id = landmark.id;
    run.map.landmarks.add(0, std::move(landmark));
    return id;
  }

  void addMeasurement(std::size_t pose, base::LandmarkId id, std::shared_ptr<const graph::Factor> factor,
                      const Eigen::VectorXd& sigmas) {
    graph::FactorRecord record{
        {frame(pose).pose, variableOf(id)}, std::move(factor), graph::SquareRootInformation::fromSigmas(sigmas)};
    record.loss = graph::Loss::huber(2);
    record.tags.landmark = id;
    run.graph.addFactor(record);
  }

  std::mt19937 random_;
  std::vector<geometry::Se2> truth_;
};

}  // namespace omnimapper::plugins

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/PlacedVariable.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SessionStart.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::mapper {

using mrpt::poses::CPose3D;

namespace {

void movePlaced(base::VariableId id, const geometry::Se3& by, graph::Graph& graph) {
  const auto* kind = dynamic_cast<const graph::PlacedVariable*>(graph.variable(id).kind.get());
  if (!kind) return;
  Eigen::VectorXd value = graph.value(id);
  kind->move(by, value.data(), value.data());
  graph.setValue(id, value);
}

}  // namespace

SessionStart startAnywhere(const map::Map& map) {
  constexpr double kLeast = 10;  // [m]; the robot may stand beside a map that is a single spot
  constexpr double kAnyHeading = geometry::kPi;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& frame : map.key_frames) {
    const auto& pose = frame.map_from_base;
    const Eigen::Vector3d place(pose.x(), pose.y(), pose.z());
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const Eigen::Vector3d centre = (low + high) / 2;
  return {CPose3D(centre.x(), centre.y(), centre.z(), 0, 0, 0), std::max(kLeast, (high - low).norm() / 2), kAnyHeading};
}

graph::FactorRecord startFactor(Motion motion, base::VariableId anchor, const SessionStart& start) {
  constexpr double kLossScale = 3;  // [sigma]
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  covariance.diagonal().head<3>().setConstant(start.position_sigma * start.position_sigma);
  covariance.diagonal().tail<3>().setConstant(start.angle_sigma * start.angle_sigma);
  auto factor = posePrior(motion, anchor, start.map_from_base, covariance, "engine");
  factor.loss = graph::Loss::cauchy(kLossScale);
  return factor;
}

std::string whyFixed(const SessionPlace& place, const graph::Graph& graph, const map::Map& map) {
  const auto& session = map.sessions.back();
  const std::string name = "session " + std::to_string(place.frame.session);
  if (place.frame.session != session.number) return name + " is not the newest";
  if (session.aligned) return name + " is aligned with the map";
  if (!map.key_frames.find(place.frame)) return name + " has no key frame " + toString(place.frame);
  if (!graph.contains(session.anchor)) return name + " has no anchor";
  for (const auto& frame : map.key_frames) {
    if (frame.id.session != session.number) continue;
    for (const auto id : graph.factorsOf(frame.pose)) {
      const auto& record = graph.factor(id);
      const bool ties = std::any_of(record.variables.begin(), record.variables.end(),
                                    [&](base::VariableId other) { return other.session != session.number; });
      if (ties && record.weight > 0) return name + " is tied to another session, which would stay behind";
    }
  }
  return {};
}

void placeSession(const SessionPlace& place, graph::Graph& graph, map::Map& map) {
  const auto& session = map.sessions.back();
  const Motion motion =
      graph.variable(session.anchor).kind->kind() == graph::se2()->kind() ? Motion::planar : Motion::spatial;
  const CPose3D new_from_old = place.start.map_from_base + (-map.keyFrame(place.frame).map_from_base);
  const auto move = [&](base::VariableId id) {
    graph.setValue(id, poseValue(motion, new_from_old + poseOf(graph, id)));
  };
  bool anchor_moved = false;
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) {
    if (map.key_frames[i].id.session != session.number) continue;
    auto& frame = map.key_frames.edit(map.key_frames[i].id);
    move(frame.pose);
    frame.map_from_base = poseOf(graph, frame.pose);
    anchor_moved = anchor_moved || frame.pose == session.anchor;
  }
  if (!anchor_moved) move(session.anchor);
  const geometry::Se3 by = geometry::fromMrpt(new_from_old);
  for (const auto& [id, landmark] : map.landmarks) {
    for (const auto variable : landmark.variables) {
      if (variable.session == session.number && graph.contains(variable)) movePlaced(variable, by, graph);
    }
  }
  const std::vector<base::FactorId> factors = graph.factorsOf(session.anchor);
  for (const auto id : factors) {
    if (graph.factor(id).variables.size() == 1) graph.removeFactor(id);
  }
  graph.addFactor(startFactor(motion, session.anchor,
                              {poseOf(graph, session.anchor), place.start.position_sigma, place.start.angle_sigma}));
}

}  // namespace omnimapper::mapper

#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/View.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace box_world {

using namespace omnimapper;
using mrpt::poses::CPose3D;

/// A room of 4 x 3 m with a pillar in its upper right part, so that it has no symmetry. Map frame, [m].
struct Wall {
  double x1, y1, x2, y2;
};
inline const std::vector<Wall>& walls() {
  static const std::vector<Wall> walls{{-1, -1, 3, -1},      {3, -1, 3, 2},        {3, 2, -1, 2},
                                       {-1, 2, -1, -1},      {2.0, 1.0, 2.4, 1.0}, {2.4, 1.0, 2.4, 1.4},
                                       {2.4, 1.4, 2.0, 1.4}, {2.0, 1.4, 2.0, 1.0}};
  return walls;
}

inline double distanceToWalls(double x, double y) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& w : walls()) {
    const double dx = w.x2 - w.x1, dy = w.y2 - w.y1;
    const double along = std::clamp(((x - w.x1) * dx + (y - w.y1) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    nearest = std::min(nearest, std::hypot(x - w.x1 - along * dx, y - w.y1 - along * dy));
  }
  return nearest;
}

/// Distance from (x, y) along `angle` to the first wall; infinite if there is none.
inline double castRay(double x, double y, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& w : walls()) {
    const double dx = w.x2 - w.x1, dy = w.y2 - w.y1, det = c * dy - s * dx;
    if (std::abs(det) < 1e-12) continue;
    const double range = ((w.x1 - x) * dy - (w.y1 - y) * dx) / det;
    const double along = ((w.x1 - x) * s - (w.y1 - y) * c) / det;
    if (range > 1e-9 && along >= 0 && along <= 1) nearest = std::min(nearest, range);
  }
  return nearest;
}

/// An exact scan of 270 deg with steps of 1 deg from a horizontal sensor; upside down if its roll is pi.
inline mrpt::obs::CObservation2DRangeScan::Ptr scanFrom(const CPose3D& map_from_base, const CPose3D& base_from_sensor,
                                                        base::Stamp stamp) {
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "LASER";
  scan->timestamp = stamp;
  scan->sensorPose = base_from_sensor;
  scan->aperture = static_cast<float>(1.5 * M_PI);
  scan->rightToLeft = true;
  scan->maxRange = 20;
  constexpr std::size_t kBeams = 271;
  scan->resizeScan(kBeams);
  const CPose3D map_from_sensor = map_from_base + base_from_sensor;
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double angle = -0.5 * scan->aperture + scan->aperture * static_cast<double>(i) / (kBeams - 1);
    const auto ahead = map_from_sensor.composePoint({std::cos(angle), std::sin(angle), 0});
    const double range = castRay(map_from_sensor.x(), map_from_sensor.y(),
                                 std::atan2(ahead.y - map_from_sensor.y(), ahead.x - map_from_sensor.x()));
    scan->setScanRange(i, static_cast<float>(range));
    scan->setScanRangeValidity(i, std::isfinite(range));
  }
  return scan;
}

inline base::Stamp at(double seconds) {
  return base::stampFromUnix(1e9) + base::durationFromSeconds(seconds);
}

using RunRecord = omnimapper::testing::HandMadeRun;

inline map::KeyFrame keyFrame(std::uint32_t index, double seconds, const CPose3D& map_from_base,
                              const CPose3D& base_from_sensor) {
  map::KeyFrame frame;
  frame.id = {0, index};
  frame.stamp = at(seconds);
  frame.map_from_base = map_from_base;
  frame.observations.push_back(scanFrom(map_from_base, base_from_sensor, frame.stamp));
  return frame;
}

/// Three key frames in the room, a dependent frame after the first, a small graph, and accepted and refused decisions.
inline RunRecord boxRun(const CPose3D& base_from_sensor = CPose3D(0.2, 0, 0.3, 0.1, 0, 0)) {
  RunRecord run;
  const std::vector<CPose3D> poses{{0, 0, 0, 0, 0, 0}, {1, 0.25, 0, 0.5, 0, 0}, {0.5, 1.25, 0, 2.5, 0, 0}};
  for (std::uint32_t i = 0; i < poses.size(); ++i) {
    run.map.key_frames.insert(keyFrame(i, i, poses[i], base_from_sensor));
  }
  const auto edit = [&](std::size_t i) -> map::KeyFrame& { return run.map.key_frames.edit(run.map.key_frames[i].id); };
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) edit(i).keyframe_from_next = poses[i + 1] - poses[i];
  edit(0).dependents.push_back({at(0.5), CPose3D(0.5, 0.1, 0, 0.2, 0, 0)});
  const auto noise3 = graph::SquareRootInformation::fromSigmas(Eigen::Vector3d(0.1, 0.1, 0.05));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const geometry::Se2 pose{poses[i].x(), poses[i].y(), poses[i].yaw()};
    edit(i).pose = run.graph.addVariable(graph::se2(), graph::toValue(pose));
  }
  const auto poseId = [&](std::size_t i) { return run.map.key_frames[i].pose; };
  const auto addFactor = [&](std::vector<base::VariableId> ids, std::shared_ptr<const graph::Factor> factor,
                             const std::string& owner) {
    graph::Tags tags;
    tags.owner = owner;
    run.graph.addFactor({std::move(ids), std::move(factor), noise3, {}, 1, tags});
  };
  addFactor({poseId(0)}, std::make_shared<graph::PriorSe2>(geometry::Se2{}), "mapper");
  addFactor({poseId(0), poseId(1)}, std::make_shared<graph::BetweenSe2>(geometry::Se2{1, 0.25, 0.5}), "odometry");
  addFactor({poseId(1), poseId(2)}, std::make_shared<graph::BetweenSe2>(geometry::Se2{0, 1.1, 2.0}), "odometry");
  const auto decide = [&](std::size_t from, std::size_t to, const std::string& kind, bool accepted,
                          const std::string& reason, const std::pair<std::string, double>& number) {
    mapper::Decision decision(run.map.key_frames[from], "laser", kind);
    decision.to = run.map.key_frames[to].id;
    decision.accepted = accepted;
    decision.reason = reason;
    decision.numbers = {number};
    decision.is_loop_closure = kind == "loop closure";
    run.decisions.push_back(std::move(decision));
  };
  decide(1, 0, "beacon measurement", true, "", {"overlap", 0.9});
  decide(2, 1, "beacon measurement", false, "too little overlap", {"overlap", 0.1});
  decide(2, 0, "loop closure", true, "", {"correction [m]", 0.125});
  decide(2, 0, "loop closure", false, "turned <too> far", {"correction [m]", 2});
  run.times.add(mapper::Stage::solve, "", 0.01);
  run.times.add(mapper::Stage::plugin, "laser", 0.02);
  for (const double plugin_ms : {1, 2, 3}) run.times.addKeyFrame({plugin_ms, plugin_ms > 1 ? 0.5 : 0, 0.1});
  run.counts.observations = 12;
  run.counts.solves = 1;
  run.solves = {{3, 3, 40.0, 20.0, 5}};
  return run;
}

/// The number that follows `label` in `text`, searched from `at` on; `at` is moved behind it. NaN if there is none.
inline double numberAfter(const std::string& text, const std::string& label, std::size_t& at) {
  at = text.find(label, at);
  if (at == std::string::npos) return NAN;
  std::size_t length = 0;
  const double value = std::stod(text.substr(at + label.size(), 32), &length);
  at += label.size() + length;
  return value;
}
inline double numberAfter(const std::string& text, const std::string& label) {
  std::size_t at = 0;
  return numberAfter(text, label, at);
}

inline std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

inline mapper::PluginContext contextFor(const std::string& folder) {
  mapper::PluginContext context;
  context.section = "output";
  context.output_folder = folder;
  context.title = "box <world>";
  context.config_text = "[mapper]\nmotion = planar & flat\n";
  return context;
}

inline void clearObservations(RunRecord& run) {
  for (std::size_t i = 0; i < run.map.key_frames.size(); ++i) {
    run.map.key_frames.edit(run.map.key_frames[i].id).observations.clear();
  }
}

}  // namespace box_world

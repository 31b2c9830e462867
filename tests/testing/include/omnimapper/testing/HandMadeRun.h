#pragma once

#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/View.h>

#include <vector>

namespace omnimapper::testing {

/// A map and graph that grow by hand, for what needs a View without an engine.
struct HandMadeRun {
  mapper::Motion motion = mapper::Motion::planar;
  map::Map map;
  graph::Graph graph;
  mapper::DecisionLog decisions;
  mapper::StageTimes times;
  mapper::RunCounts counts;
  std::vector<mapper::SolveRecord> solves;
  std::vector<std::string> warnings;
  std::vector<map::MapSection> sections;
  bool map_is_held = false;
  std::vector<mapper::LocalizationEstimate> localization;
  mapper::Verdict verdict;
  mapper::Uncertainty uncertainty;  ///< of nothing, until a test sets it

  mapper::View view() const {
    return {{map, graph, uncertainty},
            decisions,
            times,
            counts,
            solves,
            warnings,
            sections,
            map_is_held,
            localization,
            verdict};
  }

  /// A key frame of the graph's session at that estimate, one second after the one before.
  const map::KeyFrame& addFrame(const mrpt::poses::CPose3D& map_from_base) {
    map::KeyFrame frame;
    const auto index = static_cast<std::uint32_t>(map.key_frames.size());
    frame.id = map.key_frames.nextId(graph.session());
    frame.stamp = base::stampFromUnix(1'000'000'000 + static_cast<double>(index));
    frame.map_from_base = map_from_base;
    frame.pose = graph.addVariable(mapper::poseVariable(motion), mapper::poseValue(motion, map_from_base), index == 0);
    return map.key_frames[map.key_frames.insert(frame)];
  }
};

}  // namespace omnimapper::testing

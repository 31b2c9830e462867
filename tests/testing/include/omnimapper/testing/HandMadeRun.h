#pragma once

#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/View.h>

namespace omnimapper::testing {

/// A map and graph that a test fills by hand, for code that needs a View without an engine.
struct HandMadeRun : mapper::ViewedRun {
  mapper::Motion motion = mapper::Motion::planar;

  /// Adds a key frame of the graph's session at that estimate, one second after the one before.
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

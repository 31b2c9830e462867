#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Motion.h>

#include <string>

namespace omnimapper::mapper {

/// Where a session begins on a map that is continued.
struct SessionStart {
  mrpt::poses::CPose3D map_from_base;  ///< the initial estimate
  double position_sigma = 1;           ///< [m]
  double angle_sigma = 0.5;            ///< [rad]
};

/// The start of a session whose pose is unknown: anywhere among the key frames, with any heading. The map must have a
/// key frame.
SessionStart startAnywhere(const map::Map& map);

/// The initial estimate as a prior on the session's anchor, with a robust loss: if measurements contradict the prior by
/// much, it has little effect on the map.
graph::FactorRecord startFactor(Motion motion, base::VariableId anchor, const SessionStart& start);

/// A better initial estimate for a session that nothing ties to the map yet.
struct SessionPlace {
  base::KeyFrameId frame;  ///< a key frame of the newest session
  SessionStart start;      ///< where that key frame is, and how well this is known
};

/// Why the session cannot be placed, for example because it is not the newest or is aligned; empty if it can be placed.
std::string whyFixed(const SessionPlace& place, const graph::Graph& graph, const map::Map& map);

/// Moves the whole session, so that the key frame is at its new pose: key frames, anchor, the session's own landmarks,
/// and the prior on its anchor.
void placeSession(const SessionPlace& place, graph::Graph& graph, map::Map& map);

}  // namespace omnimapper::mapper

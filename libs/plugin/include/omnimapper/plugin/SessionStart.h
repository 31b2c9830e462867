#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Motion.h>

#include <string>

namespace omnimapper::mapper {

/// Where a session begins on a map that is continued.
struct SessionStart {
  mrpt::poses::CPose3D map_from_base;  ///< the guess
  double position_sigma = 1;           ///< [m]
  double angle_sigma = 0.5;            ///< [rad]
};

/// Nothing is known of it: anywhere among the key frames, any heading. On a map with at least one key frame.
SessionStart startAnywhere(const map::Map& map);

/// The guess as a factor on the session's anchor. What measurements contradict by much does not pull at the map for
/// ever.
graph::FactorRecord startFactor(Motion motion, base::VariableId anchor, const SessionStart& start);

/// A better guess for a session that nothing ties to the map yet.
struct SessionPlace {
  base::KeyFrameId frame;  ///< of the newest session
  SessionStart start;      ///< where that key frame is, and how well this is known
};

/// Why it cannot be placed: it is not the newest, or joined; empty if it can.
std::string whyFixed(const SessionPlace& place, const graph::Graph& graph, const map::Map& map);

/// Moves the session as a whole, so that its key frame is there: key frames, anchor, landmarks of its own, and the
/// guess that holds it.
void placeSession(const SessionPlace& place, graph::Graph& graph, map::Map& map);

}  // namespace omnimapper::mapper

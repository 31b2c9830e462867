#pragma once

#include <mrpt/math/TPoint3D.h>
#include <omnimapper/map/ClosedLoops.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/State.h>

#include <vector>

namespace omnimapper::derived {

/// A decision about two key frames, with their current positions.
struct Closure {
  const mapper::Decision* decision;  ///< points into the decision log
  mrpt::math::TPoint3D from, to;     ///< [m] in the map
};

/// Every loop closure that was considered between two key frames that do not follow one another, in the order of the
/// log.
std::vector<Closure> closuresOf(const map::Map& map, const mapper::DecisionLog& decisions);

/// The loop closures that the map rests on: hypotheses between two key frames that do not follow one another, which
/// have weight in the graph.
map::ClosedLoops closedLoopsOf(const mapper::State& state);

}  // namespace omnimapper::derived

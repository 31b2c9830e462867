#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

namespace omnimapper::derived {

/// Marks for each session of `map` whether factors of positive weight connect it to the first session, directly or
/// through other sessions, and which key frame such a factor connected first. A factor of one of the plugins `absolute`
/// connects a session to the map itself. A factor between landmarks alone, without a pose, does not connect sessions.
void markAligned(map::Map& map, const graph::Graph& graph, const std::set<std::string>& absolute);

/// Does the same for only the last session of a map whose older sessions are held: marks whether a factor connects the
/// last session to an aligned session or, if the factor is of a plugin of `absolute`, to the map itself.
void markLocated(map::Map& map, const graph::Graph& graph, const std::set<std::string>& absolute);

/// Counts of the hypotheses (measurements and closures) that connect a session to others. `accepted`: those that the
/// consistency test accepted. `refused`: those that the test refused, and those that still wait for it.
struct TestedTies {
  std::size_t accepted = 0, refused = 0;

  /// Whether so many were refused that the session may be aligned to a wrong place that looks similar.
  bool areMostlyRefused() const { return refused >= 3 && 2 * refused > accepted; }
};
TestedTies testedTies(const graph::Graph& graph, std::uint16_t session);

/// "session 1 was aligned at key frame 1:4" or "session 1 was never aligned".
std::string alignedText(const map::Session& session);

}  // namespace omnimapper::derived

#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

namespace omnimapper::mapper {

/// Says of each session of `map` whether factors that act tie it to the first one, be it by way of others, and which
/// key frame was first to. What the plugins `absolute` measure ties a session to the map itself; what relates landmarks
/// alone, without a pose, ties none.
void markJoined(map::Map& map, const graph::Graph& graph, const std::set<std::string>& absolute);

/// The same of the last session of a map that is held: whether something ties it to a session that is joined.
void markLocated(map::Map& map, const graph::Graph& graph, const std::set<std::string>& absolute);

/// Sightings and closures that tie a session to others by the consistency test: those that act, and those that were
/// refused or wait.
struct TestedTies {
  std::size_t accepted = 0, refused = 0;

  /// Whether so many contradict the map that the session may lie in a wrong place that looks alike.
  bool areMostlyRefused() const { return refused >= 3 && 2 * refused > accepted; }
};
TestedTies testedTies(const graph::Graph& graph, std::uint16_t session);

/// "session 1 was joined at key frame 1:4", or that it was never joined.
std::string joinedText(const map::Session& session);

}  // namespace omnimapper::mapper

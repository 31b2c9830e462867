#include <omnimapper/derived/Closures.h>

#include <cstdlib>
#include <unordered_map>

namespace omnimapper::derived {

namespace {

/// Whether one key frame, by its index in the map, follows the other in one session.
bool areNeighbours(const map::Map& map, std::size_t a, std::size_t b) {
  const auto steps = static_cast<long>(a) - static_cast<long>(b);
  return std::labs(steps) <= 1 && map.key_frames[a].id.session == map.key_frames[b].id.session;
}

}  // namespace

std::vector<Closure> closuresOf(const map::Map& map, const mapper::DecisionLog& decisions) {
  std::unordered_map<base::KeyFrameId, std::size_t> index;
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) index[map.key_frames[i].id] = i;
  std::vector<Closure> closures;
  for (const mapper::Decision& decision : decisions) {
    if (!decision.to || !decision.is_loop_closure) continue;
    const auto from = index.find(decision.from), to = index.find(*decision.to);
    if (from == index.end() || to == index.end()) continue;
    if (areNeighbours(map, from->second, to->second)) continue;
    closures.push_back({&decision, map.key_frames[from->second].map_from_base.translation(),
                        map.key_frames[to->second].map_from_base.translation()});
  }
  return closures;
}

map::ClosedLoops closedLoopsOf(const mapper::State& state) {
  const auto& frames = state.map.key_frames;
  std::unordered_map<base::VariableId, std::size_t> index;
  for (std::size_t i = 0; i < frames.size(); ++i) index[frames[i].pose] = i;
  map::ClosedLoops closed;
  for (const auto& [id, record] : state.graph.factors()) {
    if (!record.tags.hypothesis || record.weight <= 0 || record.variables.size() != 2) continue;
    const auto from = index.find(record.variables[0]), to = index.find(record.variables[1]);
    if (from == index.end() || to == index.end() || areNeighbours(state.map, from->second, to->second)) continue;
    const auto &a = frames[from->second], &b = frames[to->second];
    closed.loops.push_back({a.id,
                            b.id,
                            {a.map_from_base.x(), a.map_from_base.y()},
                            {b.map_from_base.x(), b.map_from_base.y()},
                            record.tags.owner,
                            record.tags.note});
  }
  return closed;
}

}  // namespace omnimapper::derived

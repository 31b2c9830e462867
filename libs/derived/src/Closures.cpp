#include <omnimapper/derived/Closures.h>

#include <cstdlib>
#include <unordered_map>

namespace omnimapper::derived {

std::vector<Closure> closuresOf(const map::Map& map, const mapper::DecisionLog& decisions) {
  std::unordered_map<base::KeyFrameId, std::size_t> index;
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) index[map.key_frames[i].id] = i;
  std::vector<Closure> closures;
  for (const mapper::Decision& decision : decisions) {
    if (!decision.to || !decision.is_loop_closure) continue;
    const auto from = index.find(decision.from), to = index.find(*decision.to);
    if (from == index.end() || to == index.end()) continue;
    const auto steps = static_cast<long>(from->second) - static_cast<long>(to->second);
    if (std::labs(steps) <= 1 && decision.from.session == decision.to->session) continue;
    closures.push_back({&decision, map.key_frames[from->second].map_from_base.translation(),
                        map.key_frames[to->second].map_from_base.translation()});
  }
  return closures;
}

}  // namespace omnimapper::derived
